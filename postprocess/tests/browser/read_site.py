"""Reads the site in a real browser: links, figures, equations, search, and the pages to play with.

python read_site.py BROWSER SITE, where SITE is the folder that `cargo run --release --package meniscus-site` writes.
"""

import argparse
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from playwright.sync_api import Browser, expect, sync_playwright

# Pages to play with, and the pages that show them.
PLAYED = {"validation/in-the-open.html": ["chip"], "validation/gallery.html": ["cycle", "in-time"]}
# What is not a page of the book, and is made from its pages.
OTHERS = ("api", "play", "print.html", "404.html", "toc.html")
# A word to search for, and a page that must be among what is found.
SOUGHT = ("hysteresis", "numerics/wetting.html")


class Reader(HTMLParser):
    """What a page names: its places, its links, its figures without a text in their place, and its text outside code."""

    def __init__(self, path: Path) -> None:
        """Reads a file."""
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.mute: list[str] = []
        self.equations = 0
        self.text: list[str] = []
        self.within: list[str] = []
        self.feed(path.read_text())

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Notes places, links, figures and equations."""
        found = {name: value or "" for name, value in attrs}
        self.ids |= {found[name] for name in ("id", "name") if name in found}
        self.links += [found[name] for name in ("href", "src") if name in found and tag != "base"]
        is_contents = found.get("class") == "sidebar-iframe-outer"
        if (tag == "img" and not found.get("alt")) or (tag == "iframe" and not found.get("title") and not is_contents):
            self.mute.append(found.get("src", ""))
        self.equations += tag == "math"
        if tag in ("code", "script", "style", "annotation"):
            self.within.append(tag)

    def handle_endtag(self, tag: str) -> None:
        """Leaves code."""
        if self.within and self.within[-1] == tag:
            self.within.pop()

    def handle_data(self, data: str) -> None:
        """Notes text."""
        if not self.within:
            self.text.append(data)


def check_pages(site: Path) -> int:
    """Links lead somewhere, figures and frames have a text in their place, and no equation is left in TeX. Returns the number of equations."""
    paths = [path for path in site.rglob("*.html") if path.relative_to(site).parts[0] not in OTHERS]
    pages = {path.resolve(): Reader(path) for path in paths}
    assert len(pages) > 40, f"{len(pages)} pages"
    wrong = []
    for path, page in pages.items():
        name = path.relative_to(site.resolve())
        wrong += [f"{name}: no text in place of {source}" for source in page.mute]
        wrong += [f"{name}: an equation is left in TeX" for text in page.text if "$$" in text or "\\frac" in text]
        for link in page.links:
            to = urlsplit(link)
            if to.scheme or link.startswith("//"):
                continue
            target = (path.parent / unquote(to.path)).resolve() if to.path else path
            if not target.exists():
                wrong.append(f"{name}: there is no {link}")
            elif to.fragment and target in pages and unquote(to.fragment) not in pages[target].ids:
                wrong.append(f"{name}: no place {link}")
    assert not wrong, "\n".join(wrong)
    return sum(page.equations for page in pages.values())


def check_in_browser(browser: Browser, site: Path) -> None:
    """Equations have a size, the search finds, and the pages to play with move; nothing complains or asks for a network."""
    complaints: list[str] = []
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.on("console", lambda message: complaints.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: complaints.append(request.url) if not request.url.startswith(("file:", "data:", "blob:")) else None)
    page.goto((site / "network/theory.html").resolve().as_uri())
    flat = page.eval_on_selector_all("math", "all => all.filter(it => it.getBoundingClientRect().height < 8).length")
    assert flat == 0 and page.locator("math").count() > 20, f"{flat} of {page.locator('math').count()} equations are flat"
    assert page.locator("math merror").count() == 0
    word, wanted = SOUGHT
    page.goto((site / "introduction.html").resolve().as_uri() + f"?search={word}")
    page.locator("#mdbook-searchresults li a").first.wait_for()
    found = page.eval_on_selector_all("#mdbook-searchresults li a", "all => all.map(it => it.href)")
    assert any(wanted in link for link in found), found
    for name, played in PLAYED.items():
        page.goto((site / name).resolve().as_uri())
        for network in played:
            shown = f'iframe[src$="play/{network}.html"]'
            page.locator(shown).scroll_into_view_if_needed()
            frame = page.frame_locator(shown)
            frame.locator("#first").click()
            frame.locator("#forward").click()
            # The slider follows with the next picture.
            expect(frame.locator("#slider"), f"{name}: {network} does not move").to_have_value("1")
    assert not complaints, complaints


def main() -> int:
    """Checks a site."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("browser", type=Path)
    parser.add_argument("site", type=Path)
    options = parser.parse_args()
    equations = check_pages(options.site)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(options.browser), args=["--no-sandbox"])
        check_in_browser(browser, options.site)
        browser.close()
    print(f"links, figures and {equations} equations stand, the search finds, and the pages move")
    return 0


if __name__ == "__main__":
    sys.exit(main())
