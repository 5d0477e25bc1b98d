// The drawing of a run in vectors, on three layers: fluids, of which only what has changed is drawn anew; solids with throats; interfaces and marks.

/** Number of colors from the first to the last invaded area. */
const SHADES = 64;
/** Pixels around the drawing. */
const RIM = 26;

/** The color at a fraction of a bar of colors. */
function mixed(bar, fraction) {
    const at = Math.min(Math.max(fraction, 0), 1) * (bar.length - 1);
    const below = Math.min(Math.floor(at), bar.length - 2), rest = at - below;
    const part = (color, k) => parseInt(color.slice(1 + 2 * k, 3 + 2 * k), 16);
    const mix = k => Math.round(part(bar[below], k) * (1 - rest) + part(bar[below + 1], k) * rest);
    return `rgb(${mix(0)} ${mix(1)} ${mix(2)})`;
}

/** The colors of a half cycle: those of what areas hold, then those of what came in order. */
function palette(colors, stage) {
    const [invading, other] = stage.wetting_invades ? ["wetting", "non_wetting"] : ["non_wetting", "wetting"];
    const bar = colors[`${invading}_in_order`];
    const shades = Array.from({ length: SHADES }, (_, k) => mixed(bar, (k + 0.5) / SHADES));
    return [colors[other][0], colors[`${other}_trapped`][0], colors[`${invading}_before`][0], ...shades];
}

class ChipMap {
    constructor(element, run, colors) {
        Object.assign(this, { element, run, colors, marked: null, hovered: null, zoom: 1, center: null });
        this.element.innerHTML = "";
        [this.fluids, this.solids, this.marks] = [0, 1, 2].map(() => {
            const canvas = document.createElement("canvas");
            canvas.setAttribute("aria-hidden", "true");
            this.element.append(canvas);
            return canvas.getContext("2d");
        });
        this.palettes = new Map(run.stages.map(stage => [stage, palette(colors, stage)]));
        this.findImages();
        this.paths = Array.from({ length: run.areas.count }, (_, area) => this.pathOf(area));
        this.pore = new Path2D();
        this.paths.forEach(path => this.pore.addPath(path));
        this.walls = this.pathOfWalls();
        this.findCells();
        new ResizeObserver(() => this.resize()).observe(this.element);
    }

    /** The shifts at which each area is seen in a periodic domain. */
    findImages() {
        const { areas, periodic, bounds } = this.run;
        const size = [0, 1].map(axis => bounds[1][axis] - bounds[0][axis]);
        const along = axis => (periodic[axis] ? [0, -size[axis], size[axis]] : [0]);
        const all = along(0).flatMap(dx => along(1).map(dy => [dx, dy]));
        this.shifts = Array.from({ length: areas.count }, (_, area) => {
            const [from, to] = [areas.first[area], areas.first[area + 1]];
            const ends = ["x", "y"].map(axis => {
                const values = areas[axis].subarray(from, to);
                return [Math.min(...values), Math.max(...values)];
            });
            const sees = shift => [0, 1].every(axis =>
                ends[axis][1] + shift[axis] > bounds[0][axis] && ends[axis][0] + shift[axis] < bounds[1][axis]);
            return all.filter((shift, k) => k === 0 || sees(shift));
        });
    }

    /** Adds an edge of an area, from its start, at which the path is. */
    addEdge(path, k, next, [dx, dy]) {
        const { x, y, sweep } = this.run.areas;
        const [ax, ay, bx, by] = [x[k] + dx, y[k] + dy, x[next] + dx, y[next] + dy];
        const angle = sweep[k] === NO_WALL ? 0 : sweep[k] / HALF_TURN * Math.PI;
        if (angle === 0 || (ax === bx && ay === by)) return path.lineTo(bx, by);
        const height = 0.5 / Math.tan(0.5 * angle);
        const [cx, cy] = [0.5 * (ax + bx) - height * (by - ay), 0.5 * (ay + by) + height * (bx - ax)];
        const start = Math.atan2(ay - cy, ax - cx);
        path.arc(cx, cy, Math.hypot(ax - cx, ay - cy), start, start + angle, angle < 0);
    }

    pathOf(area) {
        const { first, x, y } = this.run.areas, path = new Path2D();
        const [from, to] = [first[area], first[area + 1]];
        for (const shift of this.shifts[area]) {
            path.moveTo(x[from] + shift[0], y[from] + shift[1]);
            for (let k = from; k < to; k++) this.addEdge(path, k, k + 1 < to ? k + 1 : from, shift);
            path.closePath();
        }
        return path;
    }

    pathOfWalls() {
        const { first, x, y, sweep, count } = this.run.areas, path = new Path2D();
        for (let area = 0; area < count; area++) {
            const [from, to] = [first[area], first[area + 1]];
            for (const shift of this.shifts[area]) {
                for (let k = from; k < to; k++) {
                    if (sweep[k] === NO_WALL) continue;
                    path.moveTo(x[k] + shift[0], y[k] + shift[1]);
                    this.addEdge(path, k, k + 1 < to ? k + 1 : from, shift);
                }
            }
        }
        return path;
    }

    /** Lists of the areas and throats in each cell of a grid, to find what is under the pointer. */
    findCells() {
        const { areas, passages, bounds } = this.run;
        const size = Math.max(bounds[1][0] - bounds[0][0], bounds[1][1] - bounds[0][1]);
        this.cell = size / Math.max(4, Math.ceil(Math.sqrt(areas.count)));
        this.cells = new Map();
        const put = (kind, index, xs, ys) => {
            const at = value => Math.floor(value / this.cell);
            for (let i = at(Math.min(...xs)); i <= at(Math.max(...xs)); i++) {
                for (let j = at(Math.min(...ys)); j <= at(Math.max(...ys)); j++) {
                    const key = `${i},${j}`;
                    if (!this.cells.has(key)) this.cells.set(key, { areas: [], passages: [] });
                    this.cells.get(key)[kind].push(index);
                }
            }
        };
        const { x1, y1, x2, y2 } = passages;
        for (let area = 0; area < areas.count; area++) {
            const [from, to] = [areas.first[area], areas.first[area + 1]];
            for (const [dx, dy] of this.shifts[area]) {
                const [xs, ys] = [areas.x, areas.y].map(values => Array.from(values.subarray(from, to)));
                put("areas", area, xs.map(x => x + dx), ys.map(y => y + dy));
            }
        }
        for (let k = 0; k < passages.count; k++) {
            if (passages.throat[k] > 0) put("passages", k, [x1[k], x2[k]], [y1[k], y2[k]]);
        }
    }

    resize() {
        const [[left, bottom], [right, top]] = this.run.bounds;
        const width = this.element.clientWidth;
        const most = Math.max(220, 0.72 * window.innerHeight);
        const height = Math.min(most, (width - 2 * RIM) * (top - bottom) / (right - left) + 2 * RIM);
        if (width === this.width && height === this.height && devicePixelRatio === this.ratio) return;
        Object.assign(this, { width, height, ratio: devicePixelRatio });
        this.element.style.height = `${height}px`;
        for (const { canvas } of [this.fluids, this.solids, this.marks]) {
            canvas.width = Math.round(width * this.ratio);
            canvas.height = Math.round(height * this.ratio);
        }
        this.paintAll();
    }

    /** From units of the drawing to pixels of the page. */
    view() {
        const [[left, bottom], [right, top]] = this.run.bounds;
        const fit = Math.min((this.width - 2 * RIM) / (right - left), (this.height - 2 * RIM) / (top - bottom));
        const scale = fit * this.zoom;
        const [x, y] = this.center ?? [0.5 * (left + right), 0.5 * (bottom + top)];
        return { scale, x: 0.5 * this.width - scale * x, y: 0.5 * this.height + scale * y };
    }

    /** Sets the transformation of a layer; drawing is clipped to the domain and the frame. */
    begin(layer) {
        const { scale, x, y } = this.view(), ratio = this.ratio;
        const [[left, bottom], [right, top]] = this.run.bounds;
        layer.setTransform(ratio, 0, 0, ratio, 0, 0);
        layer.save();
        layer.beginPath();
        if (this.zoom > 1) layer.rect(RIM, RIM, this.width - 2 * RIM, this.height - 2 * RIM);
        if (this.zoom > 1) layer.clip();
        layer.setTransform(ratio * scale, 0, 0, -ratio * scale, ratio * x, ratio * y);
        layer.beginPath();
        layer.rect(left, bottom, right - left, top - bottom);
        layer.clip();
        layer.lineJoin = "round";
        this.pixel = 1 / scale;
    }

    clear(layer) {
        layer.setTransform(1, 0, 0, 1, 0, 0);
        layer.clearRect(0, 0, layer.canvas.width, layer.canvas.height);
    }

    colorOf(area, stage) {
        const { timeline, displaced } = this.run, holding = timeline.holding[area];
        if (holding !== INVADED) return holding;
        const shade = Math.floor(displaced[timeline.since[area]] / stage.largest * SHADES);
        return INVADED + Math.min(shade, SHADES - 1);
    }

    /** Draws areas in the order of their colors. */
    paintAreas(areas) {
        const stage = this.run.stageAt(this.run.timeline.row), colors = this.palettes.get(stage);
        const groups = colors.map(() => []);
        for (const area of areas) groups[this.colorOf(area, stage)].push(area);
        this.begin(this.fluids);
        // The line covers the seam between areas of one color.
        this.fluids.lineWidth = this.pixel;
        groups.forEach((group, color) => {
            if (group.length === 0) return;
            this.fluids.fillStyle = this.fluids.strokeStyle = colors[color];
            let path = this.paths[group[0]];
            if (group.length > 1) {
                path = new Path2D();
                group.forEach(area => path.addPath(this.paths[area]));
            }
            this.fluids.fill(path);
            this.fluids.stroke(path);
        });
        this.fluids.restore();
    }

    paintAll() {
        if (!this.width) return;
        this.clear(this.fluids);
        this.stage = this.run.stageAt(this.run.timeline.row);
        this.paintAreas(this.paths.keys());
        this.paintSolids();
        this.paintMarks();
    }

    paintSolids() {
        const layer = this.solids, { bounds: [[left, bottom], [right, top]], areas, passages } = this.run;
        const look = getComputedStyle(this.element), thin = areas.count > 1500 && this.zoom < 3 ? 0.5 : 1;
        this.clear(layer);
        this.begin(layer);
        layer.fillStyle = look.getPropertyValue("--solid");
        layer.fillRect(left, bottom, right - left, top - bottom);
        layer.globalCompositeOperation = "destination-out";
        layer.fill(this.pore);
        layer.globalCompositeOperation = "source-over";
        layer.strokeStyle = look.getPropertyValue("--wall");
        layer.lineWidth = 1.3 * thin * this.pixel;
        layer.stroke(this.walls);
        layer.strokeStyle = this.colors.mark[0];
        layer.lineWidth = 1.3 * thin * this.pixel;
        layer.setLineDash([4 * this.pixel, 3 * this.pixel]);
        layer.beginPath();
        for (let k = 0; k < passages.count; k++) if (passages.throat[k] > 0) this.addPassage(layer, k);
        layer.stroke();
        layer.restore();
        this.paintFrame(layer, look);
    }

    addPassage(layer, k) {
        const { x1, y1, x2, y2, one } = this.run.passages;
        for (const [dx, dy] of this.shifts[one[k]]) {
            layer.moveTo(x1[k] + dx, y1[k] + dy);
            layer.lineTo(x2[k] + dx, y2[k] + dy);
        }
    }

    /** The closed sides of the domain, and arrows through the open ones. */
    paintFrame(layer, look) {
        const { scale, x, y } = this.view(), [[left, bottom], [right, top]] = this.run.bounds;
        const { open } = this.stage, { periodic } = this.run;
        const [l, r, b, t] = [x + scale * left, x + scale * right, y - scale * bottom, y - scale * top];
        layer.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
        layer.strokeStyle = layer.fillStyle = look.getPropertyValue("--ink");
        layer.lineWidth = 1.3;
        if (this.zoom > 1) return;
        const sides = [[l, b, l, t, -1, 0], [r, b, r, t, 1, 0], [l, b, r, b, 0, 1], [l, t, r, t, 0, -1]];
        sides.forEach(([x1, y1, x2, y2, nx, ny], side) => {
            layer.beginPath();
            if (open[side] === "" && !periodic[side >> 1]) {
                layer.moveTo(x1, y1);
                layer.lineTo(x2, y2);
            }
            for (const part of open[side] === "" ? [] : [0.25, 0.5, 0.75]) {
                const sign = open[side] === "out" ? 1 : -1;
                const from = sign > 0 ? 4 : 20, to = sign > 0 ? 20 : 4;
                const [px, py] = [x1 + part * (x2 - x1), y1 + part * (y2 - y1)];
                const [ax, ay, ex, ey] = [px + nx * from, py + ny * from, px + nx * to, py + ny * to];
                layer.moveTo(ax, ay);
                layer.lineTo(ex, ey);
                for (const turn of [-1, 1]) {
                    layer.moveTo(ex, ey);
                    layer.lineTo(ex - sign * 6 * nx + turn * 4 * ny, ey - sign * 6 * ny + turn * 4 * nx);
                }
            }
            layer.stroke();
        });
    }

    /** Interfaces, which are drawn across passages, and what is under the pointer. */
    paintMarks() {
        const layer = this.marks, { passages, areas } = this.run, { one, other } = passages;
        const { holding } = this.run.timeline;
        this.clear(layer);
        this.begin(layer);
        layer.strokeStyle = this.colors.meniscus[0];
        layer.lineCap = "round";
        layer.lineWidth = (areas.count > 1500 && this.zoom < 3 ? 1.2 : 2.4) * this.pixel;
        layer.beginPath();
        for (let k = 0; k < passages.count; k++) {
            if (holding[one[k]] >= BEFORE !== holding[other[k]] >= BEFORE) this.addPassage(layer, k);
        }
        layer.stroke();
        for (const [found, width] of [[this.marked, 4], [this.hovered, 3]]) if (found) this.paintFound(layer, found, width);
        layer.restore();
    }

    paintFound(layer, { pore, throat }, width) {
        const path = new Path2D();
        if (throat !== undefined) {
            this.addPassage(path, this.run.passageOfThroat[throat]);
        } else {
            this.run.areasOfPore[pore].forEach(area => path.addPath(this.paths[area]));
        }
        for (const [color, wide] of [["#fff", width + 2], ["#000", width - 1]]) {
            layer.strokeStyle = color;
            layer.lineWidth = wide * this.pixel;
            layer.stroke(path);
        }
    }

    /** Moves to a row. */
    move(row) {
        const changed = this.run.timeline.move(row), stage = this.run.stageAt(row);
        if (!this.width) return;
        if (stage !== this.stage) return this.paintAll();
        if (changed.length > 0) this.paintAreas(new Set(changed));
        this.paintMarks();
    }

    /** Units of the drawing at pixels of the page from the corner of the map. */
    place(px, py) {
        const { scale, x, y } = this.view();
        return [(px - x) / scale, (y - py) / scale];
    }

    /** The throat or the pore at a place, `reach` pixels around throats. */
    find(px, py, reach) {
        const [x, y] = this.place(px, py), { passages, areas } = this.run, { x1, y1, x2, y2 } = passages;
        const cell = this.cells.get(`${Math.floor(x / this.cell)},${Math.floor(y / this.cell)}`);
        if (!cell) return null;
        let nearest = { distance: reach * this.pixel, passage: -1 };
        for (const k of cell.passages) {
            const [dx, dy] = [x2[k] - x1[k], y2[k] - y1[k]];
            const along = Math.min(1, Math.max(0, ((x - x1[k]) * dx + (y - y1[k]) * dy) / (dx * dx + dy * dy)));
            const distance = Math.hypot(x - x1[k] - along * dx, y - y1[k] - along * dy);
            if (distance < nearest.distance) nearest = { distance, passage: k };
        }
        if (nearest.passage >= 0) return { throat: passages.throat[nearest.passage] - 1 };
        const layer = this.marks;
        layer.setTransform(1, 0, 0, 1, 0, 0);
        const area = cell.areas.find(area => layer.isPointInPath(this.paths[area], x, y));
        return area === undefined ? null : { pore: areas.pore[area] };
    }

    /** Zooms by a factor about a place on the page. */
    zoomBy(factor, px, py) {
        const [x, y] = this.place(px, py), [[left, bottom], [right, top]] = this.run.bounds;
        this.zoom = Math.min(40, Math.max(1, this.zoom * factor));
        if (this.zoom === 1) this.center = null;
        if (this.center === null && this.zoom > 1) this.center = [0.5 * (left + right), 0.5 * (bottom + top)];
        if (this.center) {
            const [nx, ny] = this.place(px, py);
            this.center = [this.center[0] + x - nx, this.center[1] + y - ny];
        }
        this.paintAll();
    }

    /** Moves the view by pixels of the page. */
    pan(dx, dy) {
        if (!this.center) return;
        const { scale } = this.view();
        this.center = [this.center[0] - dx / scale, this.center[1] + dy / scale];
        this.paintAll();
    }
}
