"use strict";

// The data of a run: columns of numbers, and what each area holds at an event. Positions stay integers; a length in m is `step` times one.

const TYPES = { u8: Uint8Array, u16: Uint16Array, i16: Int16Array, i32: Int32Array, f32: Float32Array };
const NO_WALL = -32768;
const HALF_TURN = 32000;
const DEFENDING = 0, TRAPPED = 1, BEFORE = 2, INVADED = 3;

/** The numbers of a column. */
function unpacked(column) {
    const text = atob(column.base64);
    const bytes = new Uint8Array(text.length);
    for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
    return new TYPES[column.type](bytes.buffer);
}

/** The columns of a table by name; words are replaced by themselves. */
function unpackedTable(table) {
    const found = {};
    for (const [name, column] of Object.entries(table)) {
        const numbers = unpacked(column);
        found[name] = column.words ? Array.from(numbers, number => column.words[number]) : numbers;
    }
    return found;
}

/** The first index of each group, given their sizes, and the number of all. */
function firsts(sizes) {
    const first = new Int32Array(sizes.length + 1);
    for (let k = 0; k < sizes.length; k++) first[k + 1] = first[k] + sizes[k];
    return first;
}

/** What areas hold, and since which row: moves forward and back by the changes between two rows. */
class Timeline {
    constructor(count, rows, stages, changes) {
        this.holding = new Uint8Array(count);
        this.since = new Int32Array(count);
        this.row = 0;
        this.first = new Int32Array(rows + 1);
        this.area = [];
        this.to = [];
        this.from = [];
        this.sinceBefore = [];
        const begins = new Set(stages.slice(1).map(stage => stage.first));
        let next = 0, at = changes.rows.length > 0 ? changes.rows[0] : -1;
        for (let row = 0; row < rows; row++) {
            this.first[row] = this.area.length;
            const now = new Map();
            if (begins.has(row)) for (let area = 0; area < count; area++) now.set(area, DEFENDING);
            while (next < changes.area.length && at === row) {
                now.set(changes.area[next], changes.holding[next]);
                next += 1;
                at += next < changes.rows.length ? changes.rows[next] : 0;
            }
            for (const [area, holding] of now) this.note(row, area, holding);
        }
        this.first[rows] = this.area.length;
        this.holding.fill(DEFENDING);
        this.since.fill(0);
        this.apply(0, []);
    }

    note(row, area, holding) {
        if (this.holding[area] === holding && holding !== INVADED) return;
        this.area.push(area);
        this.to.push(holding);
        this.from.push(this.holding[area]);
        this.sinceBefore.push(this.since[area]);
        this.holding[area] = holding;
        this.since[area] = row;
    }

    apply(row, changed) {
        for (let k = this.first[row]; k < this.first[row + 1]; k++) {
            this.holding[this.area[k]] = this.to[k];
            this.since[this.area[k]] = row;
            changed.push(this.area[k]);
        }
    }

    revert(row, changed) {
        for (let k = this.first[row + 1] - 1; k >= this.first[row]; k--) {
            this.holding[this.area[k]] = this.from[k];
            this.since[this.area[k]] = this.sinceBefore[k];
            changed.push(this.area[k]);
        }
    }

    /** Moves to a row; returns the areas that changed, some maybe more than once. */
    move(row) {
        const changed = [];
        while (this.row < row) this.apply(++this.row, changed);
        while (this.row > row) this.revert(this.row--, changed);
        return changed;
    }

    /** The rows at which an area came to hold something, with what. */
    historyOf(area) {
        const found = [];
        for (let row = 0; row + 1 < this.first.length; row++) {
            for (let k = this.first[row]; k < this.first[row + 1]; k++) {
                if (this.area[k] === area) found.push({ row, holding: this.to[k] });
            }
        }
        return found;
    }
}

/** A displacement with its network. */
class Run {
    constructor(data) {
        this.title = data.title;
        this.step = data.step;
        this.depth = data.depth;
        this.periodic = data.periodic;
        this.bounds = data.bounds.map(corner => corner.map((x, axis) => (x - data.origin[axis]) / data.step));
        this.areas = unpackedTable(data.areas);
        this.areas.first = firsts(this.areas.edges);
        this.areas.count = this.areas.edges.length;
        this.passages = unpackedTable(data.passages);
        this.passages.count = this.passages.one.length;
        this.pores = unpackedTable(data.pores);
        this.throats = unpackedTable(data.throats);
        this.events = unpackedTable(data.events);
        this.curve = data.curve ? unpackedTable(data.curve) : null;
        this.rows = this.events.saturation.length;
        this.stages = data.stages.map((stage, k) => ({ ...stage, end: data.stages[k + 1]?.first ?? this.rows }));
        this.timeline = new Timeline(this.areas.count, this.rows, this.stages, unpackedTable(data.changes));
        this.pressure = this.events.capillary_pressure_Pa ?? this.events.pressure_difference_Pa;
        this.films = data.films ? unpackedTable(data.films) : null;
        if (this.films) this.findFilms();
        this.findDisplaced();
        this.findPassages();
    }

    /** For each area one edge of each width of its films, and by area and part the curvatures that films keep. */
    findFilms() {
        const { width, part, kept_row, kept_area, kept_part, kept_curvature } = this.films;
        this.edgesOfFilms = Array.from({ length: this.areas.count }, (_, area) => {
            const edges = Array.from({ length: this.areas.edges[area] }, (_, k) => this.areas.first[area] + k);
            const found = new Map(edges.filter(k => width[k] > 0).map(k => [`${part[k]} ${width[k]}`, k]));
            return [...found.values()];
        });
        this.keptFilms = new Map();
        kept_row.forEach((row, k) => {
            const key = 256 * kept_area[k] + kept_part[k];
            if (!this.keptFilms.has(key)) this.keptFilms.set(key, []);
            this.keptFilms.get(key).push({ row, curvature: kept_curvature[k] });
        });
    }

    /** The width in m of the film along an edge of an area now. */
    filmWidth(area, edge) {
        const { films, timeline: { row } } = this;
        const kept = this.keptFilms.get(256 * area + films.part[edge])?.findLast(it => it.row <= row)?.curvature;
        const curvature = (kept >= -Infinity ? kept : films.curvature[row]) + films.head[area];
        const radius = curvature > 0 ? Math.min(1 / curvature, films.largest[area]) : films.largest[area];
        return Number.isFinite(radius) ? radius * films.width[edge] : 0;
    }

    /** The displaced share of the pore space after each row of its half cycle. */
    findDisplaced() {
        const { timeline, areas } = this, all = areas.area_m2.reduce((sum, area) => sum + area, 0);
        this.displaced = new Float64Array(this.rows);
        for (const stage of this.stages) {
            let sum = 0;
            for (let row = stage.first; row < stage.end; row++) {
                for (let k = timeline.first[row]; k < timeline.first[row + 1]; k++) {
                    if (timeline.to[k] === INVADED) sum += areas.area_m2[timeline.area[k]];
                }
                this.displaced[row] = sum / all;
            }
            stage.largest = sum / all || 1;
        }
    }

    /** These areas and all beside them. */
    withNeighbors(areas) {
        const found = new Set(areas), { one, other, count } = this.passages;
        const has = new Set(areas);
        for (let k = 0; k < count; k++) {
            if (has.has(one[k])) found.add(other[k]);
            if (has.has(other[k])) found.add(one[k]);
        }
        return found;
    }

    /** The areas of each pore, and the passage and the pores of each throat. */
    findPassages() {
        const { areas, passages } = this;
        this.areasOfPore = Array.from({ length: this.pores.area_m2.length }, () => []);
        for (let area = 0; area < areas.count; area++) this.areasOfPore[areas.pore[area]].push(area);
        this.passageOfThroat = new Int32Array(this.throats.width_m.length).fill(-1);
        for (let k = 0; k < passages.count; k++) {
            if (passages.throat[k] > 0) this.passageOfThroat[passages.throat[k] - 1] = k;
        }
    }

    stageAt(row) {
        return this.stages.findLast(stage => stage.first <= row);
    }

    /** The pores of a throat. */
    poresOf(throat) {
        const passage = this.passageOfThroat[throat];
        return [this.passages.one[passage], this.passages.other[passage]].map(area => this.areas.pore[area]);
    }

    /** The rows of the events that passed a throat. */
    passesOf(throat) {
        const found = [];
        for (let row = 0; row < this.rows; row++) if (this.events.throat[row] === throat + 1) found.push(row);
        return found;
    }

    /** What most of a pore holds now, and since which row. */
    stateOf(pore) {
        const { timeline, areas } = this, sums = [0, 0, 0, 0];
        const held = this.areasOfPore[pore].map(area => {
            sums[timeline.holding[area]] += areas.area_m2[area];
            return { area: areas.area_m2[area], holding: timeline.holding[area], since: timeline.since[area] };
        });
        const half = 0.5 * sums.reduce((sum, area) => sum + area, 0);
        const invaded = sums[BEFORE] + sums[INVADED] > half;
        let passed = sums[BEFORE], since = null;
        held.filter(it => it.holding === INVADED).sort((a, b) => a.since - b.since).forEach(it => {
            if (passed <= half && passed + it.area > half) since = it.since;
            passed += it.area;
        });
        return { invaded, trapped: sums[TRAPPED] > half, since };
    }
}
