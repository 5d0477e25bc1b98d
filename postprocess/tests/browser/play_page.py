"""Plays the pages of network runs in a real browser: slider, keys, link, curve and pointer against the tables of the run.

python play_page.py BROWSER FOLDER: checks FOLDER/network.html. With --speed the slider is drawn over all events, and frames are counted.
"""

import argparse
import csv
import io
import json
import math
import sys
from collections.abc import Iterator
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, Page, sync_playwright

DESKTOP = {"width": 1280, "height": 860}
PHONE = {"width": 390, "height": 844}
# The least frames in a second while the slider moves; a busy machine may miss some of the 60.
LEAST_RATE = 30


def rows(path: Path) -> list[dict[str, str]]:
    """The rows of a table."""
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def opened(browser: Browser, path: Path, size: dict[str, int], link: str = "", **more: object) -> tuple[Page, list[str]]:
    """The page in a window of a size, and its complaints."""
    page = browser.new_context(viewport=size, **more).new_page()
    complaints: list[str] = []
    page.on("console", lambda message: complaints.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: complaints.append(request.url) if not request.url.startswith("file:") else None)
    page.goto(path.resolve().as_uri() + link)
    frames(page)
    return page, complaints


def frames(page: Page) -> None:
    """Waits until what was asked for is drawn."""
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def values(page: Page, within: str) -> dict[str, str]:
    """The named values that are shown in a part of the page."""
    found = page.eval_on_selector_all(f"{within} data", "all => all.map(it => [it.dataset.name, it.value])")
    return dict(found)


def same(found: str, wanted: str) -> bool:
    """Whether a shown value is that of a table, to the digits of single precision."""
    return math.isclose(float(found), float(wanted), rel_tol=1e-6, abs_tol=1e-12)


def check_events(page: Page, folder: Path) -> None:
    """At each position of the slider the status is the row of the table."""
    events = rows(folder / "events.csv")
    slider = page.locator("#slider")
    assert int(slider.get_attribute("max")) == len(events) - 1
    stride = max(1, len(events) // 200)
    for number in [*range(0, len(events), stride), len(events) - 1]:
        slider.evaluate("(it, value) => { it.value = value; it.dispatchEvent(new Event('input')); }", number)
        frames(page)
        shown, event = values(page, ".status"), events[number]
        text = page.locator(".status p").text_content()
        for name in ("saturation", "film_saturation", "time_s", "capillary_pressure_Pa", "meniscus_pressure_Pa", "pressure_difference_Pa"):
            if event.get(name):
                assert same(shown[name], event[name]), f"{number}: {name} {shown} {event}"
            else:
                assert name not in shown, f"{number}: {name} {shown}"
        assert event["event"] in text, f"{number}: {text}"
        assert (f"throat {event['throat']}" in text) == bool(event["throat"]), f"{number}: {text}"


def check_controls(page: Page, folder: Path) -> None:
    """Keys, buttons and the curve move; the address follows."""
    last = len(rows(folder / "events.csv")) - 1

    def at() -> int:
        frames(page)
        return int(page.locator("#slider").input_value())

    page.locator("h1").click()
    for key, wanted in [("Home", 0), ("ArrowRight", 1), ("ArrowRight", 2), ("ArrowLeft", 1), ("End", last), ("ArrowLeft", last - 1)]:
        page.keyboard.press(key)
        assert at() == wanted, f"{key}: {at()}"
    page.locator("#first").click()
    page.locator("#forward").click()
    assert at() == 1
    page.wait_for_function("location.hash === '#event=1'")
    box = page.locator("#curve canvas").last.bounding_box()
    for row in (last, last // 2, 1):
        x, y = page.evaluate("row => curve.at(curve.shown[0].points[row])", row)
        page.mouse.click(box["x"] + x, box["y"] + y)
        # Other events may lie within a pixel.
        found = page.evaluate("row => curve.at(curve.shown[0].points[row])", at())
        assert math.dist(found, (x, y)) < 1.5, f"{row}: {found} {(x, y)}"
    page.locator("h1").click()
    page.keyboard.press("Home")
    page.keyboard.press("Space")
    page.wait_for_function("document.getElementById('slider').value > 1")
    page.keyboard.press("Space")
    assert page.locator("#play").text_content() == "Play"


def heading(page: Page) -> str:
    """What is under the pointer, if anything."""
    return page.evaluate("() => document.querySelector('#found h2')?.textContent ?? ''")


def places(page: Page, folder: Path, table: str) -> Iterator[tuple[int, dict[str, str], float, float]]:
    """Rows of a table of throats or pores, with the pixels at which they are."""
    box = page.locator(".map").bounding_box()
    view = page.evaluate("() => ({ ...maps[0].view(), origin: DATA.runs[0].origin, step: DATA.runs[0].step })")
    for number, row in enumerate(rows(folder / table)):
        x, y = ((float(row[name]) - origin) / view["step"] for name, origin in zip(("x_m", "y_m"), view["origin"], strict=True))
        yield number, row, box["x"] + view["x"] + view["scale"] * x, box["y"] + view["y"] - view["scale"] * y


def check_pointer(page: Page, folder: Path) -> None:
    """Under the pointer are the throats and pores of the tables."""
    page.locator("h1").click()
    page.keyboard.press("End")
    frames(page)
    for number, row, x, y in places(page, folder, "throats.csv"):
        page.mouse.move(x, y)
        assert heading(page) == f"Throat {number}", f"throat {number}: {heading(page)}"
        shown = values(page, "#found")
        for name in ("width_m", "length_m", "conductance_m2", "conductance_m3", "entry_pressure_Pa"):
            assert name not in row or same(shown[name], row[name]), f"throat {number}: {name} {shown} {row}"
        assert shown["pores"].split() in ([row["pore_1"], row["pore_2"]], [row["pore_2"], row["pore_1"]])
        assert not row["sequence"] or row["sequence"] in shown["sequence"].split(), f"throat {number}: {shown} {row}"
    checked = 0
    throats, domain = rows(folder / "throats.csv"), json.loads((folder / "network.json").read_text())["domain_m"]
    invading = page.evaluate("() => RUNS[0].stages.at(-1).wetting_invades ? 'wetting' : 'non-wetting'")
    for number, row, x, y in places(page, folder, "pores.csv"):
        page.mouse.move(x, y)
        found = heading(page)
        if found != f"Pore {number}":
            # A throat nearly as wide as its pore passes near the middle of that, and a pore that is open at a side may have its middle on the edge.
            if found.startswith("Throat "):
                throat = throats[int(found.removeprefix("Throat "))]
                assert str(number) in (throat["pore_1"], throat["pore_2"]), f"pore {number}: {found}"
            else:
                is_on_edge = any(math.isclose(float(row[name]), end[axis]) for axis, name in enumerate(("x_m", "y_m")) for end in domain)
                assert not found and is_on_edge, f"pore {number}: {found}"
            continue
        shown = values(page, "#found")
        assert same(shown["inscribed_radius_m"], row["inscribed_radius_m"]) and same(shown["area_m2"], row["area_m2"])
        assert shown["sequence"] == row["sequence"], f"pore {number}: {shown} {row}"
        # In time, menisci may hold most of a pore before an event lets them in; until then the page has it unfilled.
        waits = "time_s" in values(page, ".status") and row["phase"] == invading and not row["sequence"]
        assert waits or shown["phase"] == row["phase"], f"pore {number}: {shown} {row}"
        checked += 1
    assert checked > 0.8 * number, f"{checked} of {number} pores"


def share_of_wetting(page: Page) -> float:
    """The share of the colored pixels of the map that are blue or green, the wetting phase; throats are magenta."""
    image = Image.open(io.BytesIO(page.locator(".map").screenshot())).convert("RGB")
    colored = [(red, green, blue) for red, green, blue in image.get_flattened_data() if max(red, green, blue) - min(red, green, blue) > 25]
    held = [(red, blue) for red, green, blue in colored if green > min(red, blue)]
    return sum(blue > red for red, blue in held) / len(held)


def check_picture(page: Page) -> None:
    """The map has as much of the wetting phase as the areas that hold it, within lines and edges; films would be more of it."""
    for number in (0, 0.3, 0.6, 1):
        page.evaluate("share => move(share * (state.positions.length - 1))", number)
        frames(page)
        stage = page.evaluate("() => RUNS[0].stageAt(state.positions[state.position][0]).wetting_invades")
        held = page.evaluate(
            "() => { const { holding } = RUNS[0].timeline, { area_m2 } = RUNS[0].areas; let sum = 0, all = 0;"
            " area_m2.forEach((area, k) => { all += area; if (holding[k] >= 2) sum += area; }); return sum / all; }"
        )
        wanted = held if stage else 1 - held
        found = share_of_wetting(page)
        assert abs(found - wanted) < 0.05, f"at {number}: {found} of the picture, {wanted} of the areas"


def rate(page: Page) -> tuple[float, float]:
    """Frames in a second while the slider moves over all events and back, and the longest frame in ms."""
    return tuple(
        page.evaluate(
            """async () => {
                const slider = document.getElementById("slider"), frame = () => new Promise(requestAnimationFrame), COUNT = 120;
                move(0);
                await frame(); await frame();
                const begin = await frame();
                let last = begin, longest = 0;
                for (let k = 0; k <= 2 * COUNT; k++) {
                    slider.value = Math.round(slider.max * (1 - Math.abs(k / COUNT - 1)));
                    slider.dispatchEvent(new Event("input"));
                    const now = await frame();
                    longest = Math.max(longest, now - last);
                    last = now;
                }
                return [(2 * COUNT + 1) / (last - begin) * 1000, longest];
            }"""
        )
    )


def main() -> int:
    """Checks a folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("browser", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--speed", action="store_true", help="count frames only")
    parser.add_argument("--pictures", type=Path, help="a folder for pictures of the page")
    options = parser.parse_args()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(options.browser), args=["--no-sandbox"])
        path = options.folder / "network.html"
        page, complaints = opened(browser, path, DESKTOP)
        if options.speed:
            found, longest = rate(page)
            print(f"{found:.1f} frames in a second, the longest {longest:.0f} ms")
            assert found > LEAST_RATE, f"{found} frames in a second"
        else:
            check_events(page, options.folder)
            check_controls(page, options.folder)
            check_pointer(page, options.folder)
            page.mouse.move(1, 1)
            page.locator("#found h2").wait_for(state="detached")
            if page.evaluate("() => RUNS[0].films === null"):
                check_picture(page)
            page.close()
            linked, more = opened(browser, path, PHONE, "#event=3", has_touch=True, is_mobile=True, color_scheme="dark")
            complaints += more
            assert linked.locator("#slider").input_value() == "3"
            wide = linked.evaluate("() => document.documentElement.scrollWidth")
            assert wide <= PHONE["width"], f"{wide} pixels on a phone of {PHONE['width']}"
            label = linked.locator(".map").get_attribute("aria-label")
            assert "event 3 of" in label and "wetting saturation" in label, label
            print("events, keys, curve, pointer and picture agree with the tables")
        assert not complaints, complaints
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
