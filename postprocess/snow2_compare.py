"""Extracts a network from an image of the same pores with PoreSpy's snow2 and prints it beside that of meniscus.

Usage: snow2_compare.py RUN [--mask mask.png] [--pixels-per-throat 8] [--picture snow2.png]. RUN is the output folder
of a network. The image is drawn from the pore regions of the run, or taken from a mask of the whole domain (solids
black). The watershed of snow2 has parameters in pixels, so that its network depends on the resolution: the median
throat is given 8 pixels unless told otherwise. Needs the packages of requirements-network.txt.
"""

import argparse
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import matplotlib
import numpy as np

from network_files import SIDES, description, table

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Solid pixels around sides that are walls: the distance transform sees nothing beyond its image.
RIM = 4
# Share of the domain that is repeated on each side where it is periodic.
OVERLAP = 0.5


def polygons(folder: Path) -> list[np.ndarray]:
    """The pore regions of a run as rings of points in m."""
    import pyvista

    collection = folder / "regions.pvd"
    files = [collection.parent / d.attrib["file"] for d in ET.parse(collection).getroot().iter("DataSet")]
    if not files:
        raise ValueError(f"{collection} lists no file")
    data = pyvista.read(files[-1])
    return [np.asarray(data.get_cell(k).points)[:, :2] for k in range(data.n_cells)]


def drawn(folder: Path, low: np.ndarray, shape: tuple[int, int], pixel: float) -> np.ndarray:
    """Pixels whose centers lie in pore regions; the first axis is x."""
    from skimage.draw import polygon

    image = np.zeros(shape, dtype=bool)
    for ring in polygons(folder):
        image[polygon(*((ring - low) / pixel - 0.5).T, shape=shape)] = True
    return image


def masked(mask: Path, shape: tuple[int, int]) -> np.ndarray:
    """A mask brought to the shape wanted: pores are bright, rows run downwards."""
    from PIL import Image

    Image.MAX_IMAGE_PIXELS = None
    with Image.open(mask) as image:
        grey = np.asarray(image.convert("F").resize(shape, Image.Resampling.BOX))
    # 16 bit images keep their range.
    return (grey > 0.5 * max(grey.max(), 1.0)).T[:, ::-1]


def extended(image: np.ndarray, about: dict) -> tuple[np.ndarray, np.ndarray]:
    """The image with walls as solid rims and periodic sides repeated, and the pixels added before it along x and y."""
    added = np.zeros((2, 2), dtype=int)
    open_sides = {about.get("inlet"), about.get("outlet")}
    for axis in (0, 1):
        if about["periodic"][axis]:
            added[axis] = round(OVERLAP * image.shape[axis])
            pad = np.zeros((2, 2), dtype=int)
            pad[axis] = added[axis]
            image = np.pad(image, pad, mode="wrap")
    for side, name in enumerate(SIDES):
        axis, end = divmod(side, 2)
        if not about["periodic"][axis] and name not in open_sides:
            pad = np.zeros((2, 2), dtype=int)
            pad[axis, end] = added[axis, end] = RIM
            image = np.pad(image, pad)
    return image, added[:, 0]


def snow2(image: np.ndarray, pixel: float) -> tuple[dict, float]:
    """The network of an image and the time that it took in s, without the compilation of the code."""
    import porespy

    porespy.settings.tqdm["disable"] = True
    # An array of square posts, to compile with.
    posts = np.add.outer(np.arange(64) % 16 // 8, np.arange(64) % 16 // 8) < 2
    porespy.networks.snow2(posts, voxel_size=pixel, boundary_width=0)
    start = time.perf_counter()
    try:
        found = porespy.networks.snow2(image, voxel_size=pixel, boundary_width=0)
    except IndexError as error:
        raise ValueError("snow2 fails on this image: fewer than two pores are left after trimming") from error
    return found.network, time.perf_counter() - start


def ours(folder: Path) -> dict:
    """Pores and throats of the run."""
    pores, throats = table(folder / "pores.csv"), table(folder / "throats.csv")
    return {
        "places": np.column_stack([pores["x_m"], pores["y_m"]]),
        "radius": pores["inscribed_radius_m"],
        "width": throats["width_m"],
        "ends": np.column_stack([throats["pore_1"], throats["pore_2"]]).astype(int),
    }


def theirs(network: dict, low: np.ndarray, high: np.ndarray, before: np.ndarray, pixel: float) -> dict:
    """The same of snow2, within the domain only."""

    def in_domain(places: np.ndarray) -> np.ndarray:
        return np.all((places >= low) & (places < high), axis=1)

    # PoreSpy counts from the center of the first pixel. Its coords are centroids, which may lie in a solid.
    origin = low + (0.5 - before) * pixel
    places = network["pore.global_peak"][:, :2] + origin
    middles = network["throat.global_peak"][:, :2] + origin
    kept, throats = in_domain(places), in_domain(middles)
    radius, ends = network["pore.inscribed_diameter"] / 2, network["throat.conns"][throats]
    width = network["throat.inscribed_diameter"][throats]
    wider = width / 2 > (1 + 1e-9) * radius[ends].min(axis=1)
    share = float(wider.mean()) if len(wider) else 0.0
    return {"places": places[kept], "radius": radius[kept], "width": width, "wider": share}


def measure(path: str | Path, mask: Path | None = None, pixels: float = 8.0) -> dict:
    """Both networks, their statistics, and the pores of meniscus that have one of snow2 within half a throat width."""
    from scipy.spatial import cKDTree

    folder = Path(path)
    about, own = description(folder), ours(folder)
    if not len(own["width"]):
        raise ValueError(f"{folder}: a network without throats has no throat width to choose the pixel by")
    low, high = np.array(about["domain_m"])
    median = float(np.median(own["width"]))
    shape = tuple(int(n) for n in np.maximum(np.round((high - low) / (median / pixels)), 1))
    pixel = float((high[0] - low[0]) / shape[0])
    image = masked(mask, shape) if mask else drawn(folder, low, shape, pixel)
    extended_image, before = extended(image, about)
    network, seconds = snow2(extended_image, pixel)
    other = theirs(network, low, high, before, pixel)
    smaller = own["radius"][own["ends"]].min(axis=1)
    own["wider"] = float(np.mean(own["width"] / 2 > (1 + 1e-9) * smaller))
    result = {"ours": own, "snow2": other, "pixel": pixel, "image": image, "seconds": seconds, "domain": (low, high)}
    result["persistence"] = about["persistence"]
    result |= {"porosity": about["porosity"], "image_porosity": float(image.mean())}
    if not len(other["places"]):
        return result | {"matched": 0.0, "radius_bias": np.nan, "radius_scatter": np.nan}
    distance, nearest = cKDTree(other["places"]).query(own["places"])
    matched = distance < median / 2
    ratio = other["radius"][nearest[matched]] / own["radius"][matched] - 1.0
    result["matched"] = float(matched.mean())
    result["radius_bias"] = float(np.median(ratio)) if matched.any() else np.nan
    result["radius_scatter"] = float(ratio.std()) if matched.any() else np.nan
    return result


def rows(found: dict) -> list[tuple[str, str, str]]:
    """The table that is printed: what, meniscus, snow2."""
    own, other = found["ours"], found["snow2"]

    def both(name: str, show) -> tuple[str, str, str]:
        return name, show(own), show(other)

    return [
        ("parameter", f"persistence {found['persistence']:g}", f"pixel {1e6 * found['pixel']:.4g} um"),
        ("porosity", f"{found['porosity']:.4f}", f"{found['image_porosity']:.4f} (image)"),
        both("pores", lambda n: f"{len(n['radius'])}"),
        both("throats", lambda n: f"{len(n['width'])}"),
        both("mean inscribed radius (um)", lambda n: f"{1e6 * np.mean(n['radius']):.4g}" if len(n["radius"]) else "-"),
        both("median throat width (um)", lambda n: f"{1e6 * np.median(n['width']):.4g}" if len(n["width"]) else "-"),
        both("throats wider than a pore", lambda n: f"{n['wider']:.1%}"),
        ("pores with one of snow2 within half a throat", f"{found['matched']:.1%}", ""),
        ("its radius, median and scatter", "", f"{found['radius_bias']:+.1%} +- {found['radius_scatter']:.1%}"),
        ("time of snow2 (s)", "", f"{found['seconds']:.2f}"),
    ]


def draw(found: dict, picture: Path) -> None:
    """Inscribed circles of both networks on the image."""
    (low, high), image = found["domain"], found["image"]
    figure, axes = plt.subplots(1, 2, figsize=(12.0, 4.6), layout="constrained")
    extent = 1e3 * np.array([low[0], high[0], low[1], high[1]])
    for axis, key, name in ((axes[0], "ours", "meniscus"), (axes[1], "snow2", "snow2")):
        network = found[key]
        axis.imshow(image.T, origin="lower", extent=extent, cmap="gray", vmin=-1.0, vmax=1.0)
        for place, radius in zip(network["places"], network["radius"], strict=True):
            axis.add_patch(plt.Circle(1e3 * place, 1e3 * radius, fill=False, color="tab:red", lw=0.9))
        title = f"{name}: {len(network['radius'])} pores, {len(network['width'])} throats"
        axis.set(xlabel="x (mm)", ylabel="y (mm)", title=title)
    figure.savefig(picture, dpi=110)
    plt.close(figure)


def main() -> None:
    """Prints the table and writes the figure."""
    parser = argparse.ArgumentParser(description="a network of meniscus beside one by snow2")
    parser.add_argument("directory", type=Path, help="output folder of a network")
    parser.add_argument("--mask", type=Path, help="image of the whole domain, solids black")
    parser.add_argument("--pixels-per-throat", type=float, default=8.0, help="pixels across the median throat")
    parser.add_argument("--picture", type=Path, default=Path("snow2.png"))
    asked = parser.parse_args()
    try:
        found = measure(asked.directory, asked.mask, asked.pixels_per_throat)
    except (OSError, ValueError, KeyError) as error:
        raise SystemExit(f"{asked.directory}: {error}") from error
    print(f"{'':46} {'meniscus':>18}  snow2")
    for name, own, other in rows(found):
        print(f"{name:46} {own:>18}  {other}")
    draw(found, asked.picture)
    print(asked.picture)


if __name__ == "__main__":
    main()
