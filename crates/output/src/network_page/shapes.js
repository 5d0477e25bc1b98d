// The shapes of a run as paths, and what lies at a place. Arcs become chords where these differ from them by less than a tolerance.

class Shapes {
    constructor(run, tolerance) {
        Object.assign(this, { run, tolerance });
        this.findImages();
        this.paths = Array.from({ length: run.areas.count }, (_, area) => this.pathOf(area));
        this.pore = new Path2D();
        this.paths.forEach(path => this.pore.addPath(path));
        this.walls = this.pathOfWalls();
        this.findCells();
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
        const start = Math.atan2(ay - cy, ax - cx), radius = Math.hypot(ax - cx, ay - cy), MOST = 8;
        const chords = Math.ceil(0.5 * Math.abs(angle) / Math.acos(Math.max(0, 1 - this.tolerance / radius)));
        if (!(chords <= MOST)) return path.arc(cx, cy, radius, start, start + angle, angle < 0);
        for (let j = 1; j < chords; j++) {
            const at = start + angle * j / chords;
            path.lineTo(cx + radius * Math.cos(at), cy + radius * Math.sin(at));
        }
        path.lineTo(bx, by);
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

    /** Adds the line across a passage, at all places where it is seen. */
    addPassage(layer, k) {
        const { x1, y1, x2, y2, one } = this.run.passages;
        for (const [dx, dy] of this.shifts[one[k]]) {
            layer.moveTo(x1[k] + dx, y1[k] + dy);
            layer.lineTo(x2[k] + dx, y2[k] + dy);
        }
    }
}
