// The drawing of a run in vectors, on three layers: fluids, of which only what has changed is drawn anew; solids with throats; interfaces and marks.

/** Number of colors from the first to the last invaded area. */
const SHADES = 64;
/** Pixels beside open sides, for arrows, and beside others. */
const RIMS = [26, 4];
/** The smallest visible width of a film in pixels. */
const THINNEST = 2;

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
        const isOpen = axis => run.stages.some(({ open }) => open[2 * axis] !== "" || open[2 * axis + 1] !== "");
        this.rim = [0, 1].map(axis => RIMS[isOpen(axis) ? 0 : 1]);
        this.filmWidths = run.films && new Float32Array(run.areas.count);
        new ResizeObserver(() => this.resize()).observe(this.element);
    }

    resize() {
        const [[left, bottom], [right, top]] = this.run.bounds;
        const width = this.element.clientWidth;
        const most = Math.max(220, 0.72 * window.innerHeight);
        const height = Math.min(most, (width - 2 * this.rim[0]) * (top - bottom) / (right - left) + 2 * this.rim[1]);
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
        const fit = Math.min((this.width - 2 * this.rim[0]) / (right - left), (this.height - 2 * this.rim[1]) / (top - bottom));
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
        layer.rect(0, 0, this.width, this.height);
        layer.clip();
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
            let path = this.shapes.paths[group[0]];
            if (group.length > 1) {
                path = new Path2D();
                group.forEach(area => path.addPath(this.shapes.paths[area]));
            }
            this.fluids.fill(path);
            this.fluids.stroke(path);
        });
        if (this.run.films) this.paintFilms(this.run.withNeighbors(areas), stage);
        this.fluids.restore();
    }

    /** Films along the walls of areas of the non-wetting phase; the solid covers the other half of each line. */
    paintFilms(areas, stage) {
        const { run } = this, { first, sweep } = run.areas, groups = new Map();
        const { scale } = this.view();
        for (const area of areas) {
            this.filmWidths[area] = this.filmWidth(area, scale);
            if (this.filmWidths[area] === 0) continue;
            const [from, to] = [first[area], first[area + 1]];
            for (let k = from; k < to; k++) {
                const width = sweep[k] === NO_WALL ? 0 : this.pixelsOfFilm(area, k, scale);
                if (width === 0) continue;
                if (!groups.has(width)) groups.set(width, new Path2D());
                for (const shift of this.shapes.shifts[area]) {
                    groups.get(width).moveTo(run.areas.x[k] + shift[0], run.areas.y[k] + shift[1]);
                    this.shapes.addEdge(groups.get(width), k, k + 1 < to ? k + 1 : from, shift);
                }
            }
        }
        this.fluids.strokeStyle = this.colors[stage.wetting_invades ? "wetting_before" : "wetting"][0];
        for (const [width, path] of groups) {
            this.fluids.lineWidth = 2 * width * this.pixel;
            this.fluids.stroke(path);
        }
    }

    /** The width of the film along an edge in half pixels. */
    pixelsOfFilm(area, k, scale) {
        const width = this.run.filmWidth(area, k) / this.run.step * scale;
        return width > 0 ? 0.5 * Math.round(2 * Math.max(width, THINNEST)) : 0;
    }

    /** The largest of those of an area; 0 where the wetting phase is. */
    filmWidth(area, scale) {
        const { run } = this, invades = run.timeline.holding[area] >= BEFORE;
        if (invades === run.stageAt(run.timeline.row).wetting_invades) return 0;
        return run.edgesOfFilms[area].reduce((most, k) => Math.max(most, this.pixelsOfFilm(area, k, scale)), 0);
    }

    /** The areas whose films have another width than they are drawn with. */
    changedFilms() {
        const { scale } = this.view(), found = [];
        for (let area = 0; area < this.filmWidths.length; area++) {
            if (this.filmWidth(area, scale) !== this.filmWidths[area]) found.push(area);
        }
        return found;
    }

    paintAll() {
        if (!this.width) return;
        this.refine();
        this.clear(this.fluids);
        this.stage = this.run.stageAt(this.run.timeline.row);
        this.paintAreas(this.shapes.paths.map((_, area) => area));
        this.paintSolids();
        this.paintMarks();
    }

    /** Sets the tolerance of shapes to a fifth of a pixel, anew if the drawing is four times larger or smaller. */
    refine() {
        const tolerance = 0.2 / this.view().scale, ratio = this.shapes?.tolerance / tolerance;
        if (!(ratio >= 0.25 && ratio <= 2)) this.shapes = new Shapes(this.run, tolerance);
    }

    paintSolids() {
        const layer = this.solids, { bounds: [[left, bottom], [right, top]], areas, passages } = this.run;
        const look = getComputedStyle(this.element), thin = areas.count > 1500 && this.zoom < 3 ? 0.5 : 1;
        this.clear(layer);
        this.begin(layer);
        layer.fillStyle = look.getPropertyValue("--solid");
        layer.fillRect(left, bottom, right - left, top - bottom);
        layer.globalCompositeOperation = "destination-out";
        layer.fill(this.shapes.pore);
        layer.globalCompositeOperation = "source-over";
        layer.strokeStyle = look.getPropertyValue("--wall");
        layer.lineWidth = 1.3 * thin * this.pixel;
        layer.stroke(this.shapes.walls);
        layer.strokeStyle = this.colors.mark[0];
        layer.lineWidth = 1.3 * thin * this.pixel;
        layer.setLineDash([4 * this.pixel, 3 * this.pixel]);
        layer.beginPath();
        for (let k = 0; k < passages.count; k++) if (passages.throat[k] > 0) this.shapes.addPassage(layer, k);
        layer.stroke();
        layer.restore();
    }

    /** The closed sides of the domain, and arrows through the open ones. */
    paintFrame(layer) {
        const look = getComputedStyle(this.element);
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
            if (holding[one[k]] >= BEFORE !== holding[other[k]] >= BEFORE) this.shapes.addPassage(layer, k);
        }
        layer.stroke();
        for (const [found, width] of [[this.marked, 4], [this.hovered, 3]]) if (found) this.paintFound(layer, found, width);
        layer.restore();
        this.paintFrame(layer);
    }

    paintFound(layer, { pore, throat }, width) {
        const path = new Path2D();
        if (throat !== undefined) {
            this.shapes.addPassage(path, this.run.passageOfThroat[throat]);
        } else {
            this.run.areasOfPore[pore].forEach(area => path.addPath(this.shapes.paths[area]));
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
        const areas = new Set(this.run.films ? [...changed, ...this.changedFilms()] : changed);
        if (stage !== this.stage) this.shapes.paths.forEach((_, area) => areas.add(area));
        this.stage = stage;
        if (areas.size > 0) this.paintAreas(areas);
        this.paintMarks();
    }

    /** Units of the drawing at pixels of the page from the corner of the map. */
    place(px, py) {
        const { scale, x, y } = this.view();
        return [(px - x) / scale, (y - py) / scale];
    }

    /** The throat or the pore at a place: `reach` pixels around throats, but less than reaches the middles of the pores beside them. */
    find(px, py, reach) {
        if (!this.shapes) return null;
        const [x, y] = this.place(px, py), { passages, areas } = this.run, { x1, y1, x2, y2 } = passages;
        const cell = this.shapes.cells.get(`${Math.floor(x / this.shapes.cell)},${Math.floor(y / this.shapes.cell)}`);
        if (!cell) return null;
        let nearest = { distance: Infinity, passage: -1 };
        for (const k of cell.passages) {
            const [dx, dy] = [x2[k] - x1[k], y2[k] - y1[k]];
            const along = Math.min(1, Math.max(0, ((x - x1[k]) * dx + (y - y1[k]) * dy) / (dx * dx + dy * dy)));
            const distance = Math.hypot(x - x1[k] - along * dx, y - y1[k] - along * dy);
            const within = Math.min(reach * this.pixel, Math.max(this.pixel, Math.hypot(dx, dy) / 3));
            if (distance < Math.min(within, nearest.distance)) nearest = { distance, passage: k };
        }
        if (nearest.passage >= 0) return { throat: passages.throat[nearest.passage] - 1 };
        const layer = this.marks;
        layer.setTransform(1, 0, 0, 1, 0, 0);
        const area = cell.areas.find(area => layer.isPointInPath(this.shapes.paths[area], x, y));
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
