// The controls: a slider over positions, each with a row of every run; keys, the status, and what is under the pointer.

const element = id => document.getElementById(id);

/** A number with four digits, as people write it. */
function shortNumber(value) {
    if (!Number.isFinite(value)) return "none";
    if (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6)) {
        const [digits, power] = value.toExponential(3).split("e");
        return `${Number(digits)}·10${[...String(Number(power))].map(c => "⁰¹²³⁴⁵⁶⁷⁸⁹"["0123456789".indexOf(c)] ?? "⁻").join("")}`;
    }
    return String(Number(value.toPrecision(4)));
}

/** A length with a prefix. */
function lengthText(value) {
    const [factor, unit] = [[1, "m"], [1e-3, "mm"], [1e-6, "µm"], [1e-9, "nm"]].find(([factor]) => value >= factor * 0.9999) ?? [1, "m"];
    return `${Number((value / factor).toPrecision(4))} ${unit}`;
}

/** The columns that are shown of pores and throats: name, text, and how a value is written. */
const ROWS = {
    width_m: ["width", lengthText],
    length_m: ["length, pore to pore", lengthText],
    entry_pressure_Pa: ["entry pressure", value => `${shortNumber(value)} Pa`],
    conductance_m2: ["conductance per depth", value => `${shortNumber(value)} m²`],
    conductance_m3: ["conductance", value => `${shortNumber(value)} m³`],
    inscribed_radius_m: ["inscribed radius", lengthText],
    area_m2: ["area", value => `${shortNumber(value * 1e12)} µm²`],
    volume_m3: ["volume", value => `${shortNumber(value)} m³`],
};

const DATA = JSON.parse(element("data").textContent);
const RUNS = DATA.runs.map(run => new Run(run));
const state = { position: 0, along: "events", playing: null, positions: [] };

/** The positions of the slider, each with a row of every run. */
function positionsAlong(along) {
    const [first] = RUNS;
    if (RUNS.length === 1 && along === "events") return Array.from({ length: first.rows }, (_, row) => [row]);
    if (along === "time") {
        const COUNT = 1000, times = RUNS.map(run => run.events.time_s);
        const end = Math.max(...times.map(times => times.at(-1)));
        return Array.from({ length: COUNT + 1 }, (_, k) => times.map(times => times.findLastIndex(time => time <= end * k / COUNT * (1 + 1e-9))));
    }
    return RUNS[0].stages.flatMap((_, k) => positionsOfStage(k, along));
}

/** Positions at equal displaced share or pressure in half cycle `k` of all runs. */
function positionsOfStage(k, along) {
    const keys = RUNS.map(run => {
        const stage = run.stages[Math.min(k, run.stages.length - 1)];
        const key = row => (along !== "pressure" ? run.displaced[row] : (stage.wetting_invades ? -1 : 1) * run.pressure[row]);
        return Array.from({ length: stage.end - stage.first }, (_, j) => ({ row: stage.first + j, key: j === 0 ? -Infinity : key(stage.first + j) }));
    });
    const all = [...new Set(keys.flat().map(it => it.key))].sort((a, b) => a - b);
    const next = keys.map(() => 0);
    return all.map(key => keys.map((rows, run) => {
        while (next[run] + 1 < rows.length && rows[next[run] + 1].key <= key) next[run] += 1;
        return rows[next[run]].row;
    }));
}

function eventText(run, row) {
    const stage = run.stageAt(row), { event, throat } = run.events;
    const number = row - stage.first, last = stage.end - stage.first - 1;
    if (number === 0) return `${stage.name}: beginning`;
    const where = throat[row] > 0 ? ` through throat ${throat[row] - 1}` : "";
    const reaches = stage.breakthrough === row ? ", breakthrough" : "";
    return `${stage.name}, event ${number} of ${last}: ${event[row]}${where}${reaches}`;
}

/** Name, value and text of what is known at a row. */
function valuesAt(run, row) {
    const { time_s, saturation, film_saturation, meniscus_pressure_Pa } = run.events;
    const found = [];
    if (time_s) found.push(["time_s", "time", time_s[row], `${shortNumber(time_s[row])} s`]);
    const pressure = time_s ? ["pressure_difference_Pa", "pressure difference"] : ["capillary_pressure_Pa", "capillary pressure"];
    if (Number.isFinite(run.pressure[row])) found.push([...pressure, run.pressure[row], `${shortNumber(run.pressure[row])} Pa`]);
    if (Number.isFinite(meniscus_pressure_Pa[row])) {
        found.push(["meniscus_pressure_Pa", "at this meniscus", meniscus_pressure_Pa[row], `${shortNumber(meniscus_pressure_Pa[row])} Pa`]);
    }
    found.push(["saturation", "wetting saturation", saturation[row], saturation[row].toFixed(4)]);
    if (film_saturation) found.push(["film_saturation", "of this in films", film_saturation[row], film_saturation[row].toFixed(4)]);
    return found;
}

function list(rows) {
    const items = document.createElement("dl");
    for (const [name, label, value, text] of rows) {
        const term = document.createElement("dt"), data = document.createElement("data"), cell = document.createElement("dd");
        term.textContent = label;
        Object.assign(data, { value: String(value), textContent: text });
        data.dataset.name = name;
        cell.append(data);
        items.append(term, cell);
    }
    return items;
}

/** The names of the events in rows. */
const eventsText = (run, rows) => rows.map(row => eventText(run, row)).join("; ");

function describedThroat(run, throat) {
    const rows = Object.keys(ROWS).filter(name => name in run.throats)
        .map(name => [name, ROWS[name][0], run.throats[name][throat], ROWS[name][1](run.throats[name][throat])]);
    const passes = run.passesOf(throat), [one, other] = run.poresOf(throat);
    rows.push(["pores", "between", `${one} ${other}`, `pore ${one} and pore ${other}`]);
    const sequences = passes.map(row => row - run.stageAt(row).first);
    rows.push(["sequence", "passed by", sequences.join(" "), passes.length === 0 ? "no event" : eventsText(run, passes)]);
    return [`Throat ${throat}`, rows];
}

function describedPore(run, pore) {
    const rows = Object.keys(ROWS).filter(name => name in run.pores)
        .map(name => [name, ROWS[name][0], run.pores[name][pore], ROWS[name][1](run.pores[name][pore])]);
    const { invaded, trapped, since } = run.stateOf(pore), stage = run.stageAt(run.timeline.row);
    const phase = invaded === stage.wetting_invades ? "wetting" : "non-wetting";
    rows.push(["phase", "holds now", phase, trapped ? `${phase}, trapped` : phase]);
    if (since !== null) {
        rows.push(["sequence", "invaded by", since - stage.first, eventText(run, since)]);
        if (Number.isFinite(run.pressure[since])) {
            rows.push(["invasion_pressure_Pa", "at", run.pressure[since], `${shortNumber(run.pressure[since])} Pa`]);
        }
    } else {
        rows.push(["sequence", "invaded by", "", "no event of this half cycle so far"]);
    }
    return [`Pore ${pore}`, rows];
}

/** Shows what was found in a run. */
function showFound(index, found) {
    const target = element("found");
    target.innerHTML = "";
    if (!found) {
        target.innerHTML = "<p class=\"hint\">Point at a pore or a throat, or tap it.</p>";
        return;
    }
    const [title, rows] = found.throat === undefined ? describedPore(RUNS[index], found.pore) : describedThroat(RUNS[index], found.throat);
    const heading = document.createElement("h2");
    heading.textContent = RUNS.length > 1 ? `${title} of ${RUNS[index].title}` : title;
    target.append(heading, list(rows));
}

let maps = [], curve = null, shown = null;

function showStatus() {
    const rows = state.positions[state.position];
    rows.forEach((row, k) => {
        const run = RUNS[k], target = document.querySelectorAll(".status")[k];
        const text = eventText(run, row);
        target.replaceChildren(Object.assign(document.createElement("p"), { textContent: text }), list(valuesAt(run, row)));
        const map = document.querySelectorAll(".map")[k];
        map.setAttribute("aria-label", `Drawing of the pore space. ${text}. ${valuesAt(run, row).map(([, label, , text]) => `${label} ${text}`).join(", ")}.`);
    });
    const slider = element("slider");
    slider.value = state.position;
    slider.setAttribute("aria-valuetext", eventText(RUNS[0], rows[0]));
    if (shown) showFound(shown.index, shown.found);
}

/** Moves to a position; drawing follows with the next frame. */
let isDrawn = true;
function move(position) {
    state.position = Math.min(Math.max(Math.round(position), 0), state.positions.length - 1);
    if (!isDrawn) return;
    isDrawn = false;
    requestAnimationFrame(() => {
        isDrawn = true;
        const rows = state.positions[state.position];
        maps.forEach((map, k) => map.move(rows[k]));
        curve.move(rows);
        showStatus();
        showLegend();
    });
    clearTimeout(move.timer);
    move.timer = setTimeout(() => history.replaceState(null, "", `#event=${state.positions[state.position][0]}`), 200);
}

/** The position at or after a row of a run. */
function positionOf(run, row) {
    const found = state.positions.findIndex(rows => rows[run] >= row);
    return found < 0 ? state.positions.length - 1 : found;
}

function setAlong(along) {
    const row = state.positions.length > 0 ? state.positions[state.position][0] : 0;
    Object.assign(state, { along, positions: positionsAlong(along) });
    Object.assign(element("slider"), { min: 0, max: state.positions.length - 1, step: 1 });
    move(positionOf(0, row));
}

function play(on) {
    const button = element("play");
    button.textContent = on ? "Pause" : "Play";
    state.playing = on;
    if (!on) return;
    // All positions in 20 seconds, at least two a second.
    const SECONDS = 20, rate = Math.max(2, state.positions.length / SECONDS);
    const last = state.positions.length - 1, from = state.position >= last ? 0 : state.position;
    let begin = null;
    const frame = now => {
        if (!state.playing) return;
        begin ??= now;
        move(from + Math.floor((now - begin) / 1000 * rate));
        if (state.position >= last) return play(false);
        requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
}

/** Colors of what areas hold in the present half cycle. */
function showLegend() {
    const run = RUNS[0], stage = run.stageAt(state.positions[state.position][0]);
    if (showLegend.stage === stage) return;
    showLegend.stage = stage;
    const [invading, other] = stage.wetting_invades ? ["wetting", "non-wetting"] : ["non-wetting", "wetting"];
    const key = phase => phase.replace("-", "_"), { colors } = DATA;
    const films = run.films && !stage.wetting_invades ? `${other} and films` : other;
    const entries = [[colors[key(other)], films], [colors[`${key(other)}_trapped`], `${other}, trapped`]];
    const before = [stage !== run.stages[0] && `${invading} before`, run.films && stage.wetting_invades && "films"].filter(Boolean);
    if (before.length > 0) entries.push([colors[`${key(invading)}_before`], before.join(" and ")]);
    entries.push([["var(--solid)"], "solid"], [colors.meniscus, "interfaces, at throats"], [colors.mark, "throats"]);
    const bar = `linear-gradient(to right, ${colors[`${key(invading)}_in_order`].join(", ")})`;
    const order = `<span class="bar"><span>${invading}, displaced share at invasion: 0</span><i style="background:${bar}"></i><span>${shortNumber(stage.largest)}</span></span>`;
    element("legend").innerHTML = order + entries.map(([color, name]) => `<span><i style="background:${color}"></i>${name}</span>`).join("");
}

/** What a run is of, in one line. */
function aboutText(run, data) {
    const [low, high] = data.bounds, size = [0, 1].map(axis => lengthText(high[axis] - low[axis]));
    const depth = run.depth ? `${lengthText(run.depth)} deep` : "plane, per meter of depth";
    const names = run.stages.map(stage => stage.name).join(", ");
    return `${run.pores.area_m2.length} pores, ${run.throats.width_m.length} throats; ${size.join(" by ")}, ${depth}; ${names}; ${run.rows - run.stages.length} events`;
}

function watch(map, index) {
    const target = map.element, pointers = new Map();
    const place = event => {
        const { left, top } = target.getBoundingClientRect();
        return [event.clientX - left, event.clientY - top];
    };
    const hover = (event, reach) => {
        map.hovered = map.find(...place(event), reach);
        shown = map.hovered && { index, found: map.hovered };
        map.paintMarks();
        showFound(index, map.hovered);
    };
    target.addEventListener("pointerdown", event => {
        pointers.set(event.pointerId, place(event));
        if (event.pointerType !== "mouse") hover(event, 14);
    });
    target.addEventListener("pointermove", event => {
        const before = pointers.get(event.pointerId), now = place(event);
        if (!before) return hover(event, 7);
        if (pointers.size === 2) {
            const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
            const distance = at => Math.hypot(at[0] - other[0], at[1] - other[1]);
            map.zoomBy(distance(now) / distance(before), 0.5 * (now[0] + other[0]), 0.5 * (now[1] + other[1]));
        } else {
            map.pan(now[0] - before[0], now[1] - before[1]);
        }
        pointers.set(event.pointerId, now);
    });
    for (const end of ["pointerup", "pointercancel", "pointerleave"]) target.addEventListener(end, event => pointers.delete(event.pointerId));
    target.addEventListener("pointerleave", event => {
        if (event.pointerType !== "mouse") return;
        map.hovered = shown = null;
        map.paintMarks();
        showFound(index, null);
    });
    target.addEventListener("wheel", event => {
        event.preventDefault();
        map.zoomBy(Math.exp(-0.002 * event.deltaY), ...place(event));
    }, { passive: false });
    target.addEventListener("dblclick", () => map.zoomBy(1e-9, 0, 0));
}

function listen() {
    const step = by => { play(false); move(state.position + by); };
    const far = () => Math.max(1, Math.round(state.positions.length / 20));
    const actions = {
        ArrowRight: () => step(1), ArrowUp: () => step(1), ArrowLeft: () => step(-1), ArrowDown: () => step(-1),
        PageUp: () => step(far()), PageDown: () => step(-far()), Home: () => step(-Infinity), End: () => step(Infinity),
        " ": () => play(!state.playing),
    };
    addEventListener("keydown", event => {
        if (event.ctrlKey || event.altKey || event.metaKey || event.target.tagName === "SELECT") return;
        // Buttons have the space bar for themselves.
        if (!(event.key in actions) || (event.key === " " && event.target.tagName === "BUTTON")) return;
        event.preventDefault();
        actions[event.key]();
    });
    element("slider").addEventListener("input", event => { play(false); move(Number(event.target.value)); });
    const buttons = { first: "Home", back: "ArrowLeft", play: " ", forward: "ArrowRight", last: "End" };
    for (const [id, key] of Object.entries(buttons)) element(id).addEventListener("click", () => actions[key]());
    element("along").addEventListener("change", event => setAlong(event.target.value));
    element("axes").addEventListener("change", event => curve.choose(event.target.value));
    addEventListener("hashchange", openLink);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { maps.forEach(map => map.paintAll()); curve.paint(); });
}

function openLink() {
    const found = /event=(\d+)/.exec(location.hash);
    if (found) move(positionOf(0, Number(found[1])));
}

function fill(select, names) {
    select.replaceChildren(...names.map(name => Object.assign(document.createElement("option"), { value: name, textContent: name })));
    select.parentElement.hidden = names.length < 2;
}

/** Gives each half cycle of all runs the same range of colors. */
function shareColors() {
    const most = k => Math.max(...RUNS.map(run => run.stages[k]?.largest ?? 0));
    RUNS.forEach(run => run.stages.forEach((stage, k) => { stage.largest = most(k); }));
}

function begin() {
    const frame = element("maps");
    shareColors();
    RUNS.forEach((run, k) => {
        const part = document.createElement("section");
        part.innerHTML = "<p class=\"about\"></p><div class=\"map\" role=\"img\"></div><div class=\"status\"></div>";
        const [about, map, status] = part.children;
        about.textContent = aboutText(run, DATA.runs[k]);
        if (RUNS.length > 1) {
            const name = document.createElement("b");
            name.textContent = `${run.title}: `;
            name.style.color = `var(${["--one", "--other"][k]})`;
            about.prepend(name);
        }
        frame.append(part);
        if (RUNS.length === 1) element("side").prepend(status);
        maps.push(new ChipMap(map, run, DATA.colors));
        watch(maps[k], k);
    });
    const canvases = [...element("curve").querySelectorAll("canvas")];
    curve = new Curve(canvases, RUNS, DATA.colors, (run, row) => { play(false); move(positionOf(run, row)); });
    const inTime = RUNS.every(run => run.events.time_s), single = RUNS.length === 1;
    fill(element("along"), single ? ["events", ...(inTime ? ["time"] : [])] : ["saturation", inTime ? "time" : "pressure"]);
    fill(element("axes"), Object.keys(choicesOf(RUNS[0])));
    element("axes").parentElement.hidden ||= !inTime;
    listen();
    showFound(0, null);
    setAlong(element("along").value);
    if (location.hash === "") move(state.positions.length - 1);
    openLink();
}

begin();
