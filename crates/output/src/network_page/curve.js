// Curves of one or two runs; a press on a point opens the event.

/** Round numbers along an axis, about `count` of them. */
function ticks(low, high, count) {
    const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map(digit => digit * power).find(step => step >= rough);
    const first = Math.ceil(low / step - 1e-9);
    const number = Math.floor(high / step + 1e-9) - first + 1;
    return Array.from({ length: Math.max(0, number) }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

/** What may be drawn over what, by the columns of the events. */
function choicesOf(run) {
    const { time_s, saturation } = run.events, pressure = run.pressure;
    const over = (x, y, labels) => ({ x, y, labels });
    const wetting = "saturation of the wetting phase";
    const name = time_s ? "pressure difference (Pa)" : "capillary pressure p_n − p_w (Pa)";
    if (time_s) {
        return { "pressure over saturation": over(saturation, pressure, [wetting, name]),
            "pressure over time": over(time_s, pressure, ["time (s)", name]),
            "saturation over time": over(time_s, saturation, ["time (s)", wetting]) };
    }
    if (pressure.some(Number.isFinite)) {
        return { "pressure over saturation": { ...over(saturation, pressure, [wetting, name]), stairs: true } };
    }
    const numbers = Float64Array.from(saturation, (_, row) => row);
    return { "saturation over events": over(numbers, saturation, ["event", wetting]) };
}

/** The line of each half cycle as points: the pressure changes at constant saturation, and the saturation at constant pressure. */
function linesOf(run, { x, y, stairs }) {
    let last = null;
    return run.stages.map((stage, k) => {
        let points = last ? [last] : [];
        if (stairs && run.curve) {
            const { half_cycle, saturation, capillary_pressure_Pa } = run.curve;
            half_cycle.forEach((half, row) => half === k + 1 && points.push([saturation[row], capillary_pressure_Pa[row]]));
        } else if (stairs) {
            let before = x[stage.first];
            for (let row = stage.first + 1; row < stage.end; row++) {
                if (points.length === 1) points.push([points[0][0], y[row]]);
                points.push([before, y[row]], [x[row], y[row]]);
                before = x[row];
            }
        } else {
            for (let row = stage.first; row < stage.end; row++) points.push([x[row], y[row]]);
        }
        points = points.filter(point => point.every(Number.isFinite));
        last = points.at(-1) ?? last;
        return points;
    });
}

/** The point of each row on the curve; at the beginning of a half cycle that of the next event. */
function pointsOf(run, { x, y }) {
    return Array.from(x, (value, row) => {
        const begins = run.stages.some(stage => stage.first === row);
        return [value, Number.isFinite(y[row]) || !begins ? y[row] : y[row + 1]];
    });
}

class Curve {
    /** `pick` gets the number of a run and a row. */
    constructor(canvases, runs, colors, pick) {
        [this.lines, this.marks] = canvases.map(canvas => canvas.getContext("2d"));
        Object.assign(this, { runs, colors, rows: runs.map(() => 0) });
        this.choose(Object.keys(choicesOf(runs[0]))[0]);
        const target = this.marks.canvas;
        const press = event => {
            const { left, top } = target.getBoundingClientRect();
            const found = this.nearest(event.clientX - left, event.clientY - top);
            if (found) pick(found.run, found.row);
        };
        target.addEventListener("pointerdown", event => { target.setPointerCapture(event.pointerId); press(event); });
        target.addEventListener("pointermove", event => event.buttons & 1 && press(event));
        new ResizeObserver(() => this.resize()).observe(target);
    }

    choose(name) {
        this.shown = this.runs.map(run => {
            const choices = choicesOf(run), choice = choices[name] ?? Object.values(choices)[0];
            return { choice, lines: linesOf(run, choice), points: pointsOf(run, choice) };
        });
        const all = this.shown.flatMap(shown => [...shown.lines.flat(), ...shown.points]).filter(it => it.every(Number.isFinite));
        this.ends = [0, 1].map(axis => {
            let [low, high] = all.reduce(([low, high], point) => [Math.min(low, point[axis]), Math.max(high, point[axis])], [Infinity, -Infinity]);
            const isShare = this.shown[0].choice.labels[axis].startsWith("saturation");
            if (isShare) [low, high] = [Math.min(low, 0), Math.max(high, 1)];
            if (low > 0 && low < 0.5 * high) low = 0;
            const room = 0.04 * (high - low || Math.abs(high) || 1);
            return [low === 0 ? 0 : low - (isShare ? 0 : room), isShare ? high : high + room];
        });
        this.paint();
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.marks.canvas;
        if (width === 0) return;
        Object.assign(this, { width, height });
        for (const { canvas } of [this.lines, this.marks]) {
            canvas.width = Math.round(width * devicePixelRatio);
            canvas.height = Math.round(height * devicePixelRatio);
        }
        this.paint();
    }

    /** Pixels of a point. */
    at([x, y]) {
        const [[x0, x1], [y0, y1]] = this.ends, { left, bottom } = this.room;
        return [left + (x - x0) / (x1 - x0) * (this.width - left - 12), this.height - bottom - (y - y0) / (y1 - y0) * (this.height - bottom - 10)];
    }

    strokeOf(run, stage) {
        const name = this.runs[run].stages[stage].wetting_invades ? "wetting_trapped" : "non_wetting_trapped";
        return this.runs.length > 1 ? ["var(--one)", "var(--other)"][run] : this.colors[name][0];
    }

    paint() {
        if (!this.width) return;
        const layer = this.lines, look = getComputedStyle(layer.canvas), ink = look.getPropertyValue("--ink");
        layer.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
        layer.clearRect(0, 0, this.width, this.height);
        layer.font = `13px ${look.fontFamily}`;
        layer.fillStyle = ink;
        const [xs, ys] = [ticks(...this.ends[0], this.width / 90), ticks(...this.ends[1], this.height / 45)];
        const texts = ys.map(shortNumber);
        this.room = { left: 34 + Math.max(...texts.map(text => layer.measureText(text).width)), bottom: 44 };
        layer.strokeStyle = look.getPropertyValue("--grid");
        layer.lineWidth = 1;
        layer.beginPath();
        const [[x0, x1], [y0, y1]] = this.ends;
        for (const x of xs) { layer.moveTo(...this.at([x, y0])); layer.lineTo(...this.at([x, y1])); }
        for (const y of ys) { layer.moveTo(...this.at([x0, y])); layer.lineTo(...this.at([x1, y])); }
        layer.stroke();
        layer.textAlign = "center";
        for (const x of xs) layer.fillText(shortNumber(x), this.at([x, y0])[0], this.height - 27);
        layer.textAlign = "right";
        ys.forEach((y, k) => layer.fillText(texts[k], this.room.left - 5, this.at([x0, y])[1] + 4));
        layer.textAlign = "center";
        const [horizontal, vertical] = this.shown[0].choice.labels;
        layer.fillText(horizontal, 0.5 * (this.room.left + this.width), this.height - 6);
        layer.translate(13, 0.5 * (this.height - this.room.bottom));
        layer.rotate(-0.5 * Math.PI);
        layer.fillText(vertical, 0, 0);
        layer.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
        layer.lineWidth = 1.8;
        layer.lineJoin = "round";
        this.shown.forEach(({ lines }, run) => lines.forEach((points, stage) => {
            const stroke = this.strokeOf(run, stage);
            layer.strokeStyle = stroke.startsWith("var") ? look.getPropertyValue(stroke.slice(4, -1)) : stroke;
            layer.setLineDash(stage > 1 ? [6, 4] : []);
            layer.beginPath();
            points.forEach((point, k) => k === 0 ? layer.moveTo(...this.at(point)) : layer.lineTo(...this.at(point)));
            layer.stroke();
        }));
        layer.setLineDash([]);
        this.paintBreakthroughs(layer, ink);
        this.mark();
    }

    /** Rings where the invading phase reaches the outlet. */
    paintBreakthroughs(layer, ink) {
        layer.strokeStyle = ink;
        layer.lineWidth = 1.5;
        this.runs.forEach((run, k) => run.stages.forEach(({ breakthrough }) => {
            const point = this.shown[k].points[breakthrough];
            if (!point?.every(Number.isFinite)) return;
            layer.beginPath();
            layer.arc(...this.at(point), 4, 0, 2 * Math.PI);
            layer.stroke();
        }));
    }

    move(rows) {
        this.rows = rows;
        this.mark();
    }

    /** The present points. */
    mark() {
        if (!this.width) return;
        const layer = this.marks, look = getComputedStyle(layer.canvas);
        layer.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
        layer.clearRect(0, 0, this.width, this.height);
        this.rows.forEach((row, run) => {
            const point = this.shown[run].points[row];
            if (!point.every(Number.isFinite)) return;
            layer.beginPath();
            layer.arc(...this.at(point), 6, 0, 2 * Math.PI);
            layer.fillStyle = this.runs.length > 1 ? look.getPropertyValue(["--one", "--other"][run]) : this.colors.mark[0];
            layer.strokeStyle = look.getPropertyValue("--paper");
            layer.lineWidth = 2;
            layer.fill();
            layer.stroke();
        });
    }

    /** The run and the row whose point is nearest to pixels. */
    nearest(px, py) {
        let found = null, least = Infinity;
        this.shown.forEach(({ points }, run) => points.forEach((point, row) => {
            const [x, y] = this.at(point), distance = Math.hypot(x - px, y - py);
            if (distance < least) [found, least] = [{ run, row }, distance];
        }));
        return found;
    }
}
