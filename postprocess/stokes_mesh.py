"""Meshes of triangles for the pore space between grains: fitted to the walls, finest in narrow gaps, periodic or not.

Discs and polygons stand in a box whose sides are joined along each axis ("periodic"), solid ("wall") or open ("open").
Edges are a share of the local gap, the sum of the distances of the two nearest walls, so that every gap has as many
elements across. Points lie on the walls and on the cells of a quadtree between them; they are moved as if edges were
springs (Persson, Strang 2004) and joined by Delaunay's triangulation, which keeps the walls because points are dense
on them: the area of the mesh is checked against that of the pore space. Triangles have six nodes, and those on
circles lie on the circles. Left out: grains that touch, overlap, or cross a side that is not periodic.
"""

import itertools
from dataclasses import dataclass

import numpy as np
from scipy.spatial import Delaunay

INSIDE, OPEN = -1, -2
# Length of an edge at a convex corner of a grain over that away from it: the gradients of the flow have a peak there.
CORNER = 1 / 16
# By how much edges may grow per length away from a corner.
GROWTH = 0.4


@dataclass
class Disc:
    """A round grain: its center and radius."""

    center: np.ndarray
    radius: float

    def moved(self, shift: np.ndarray) -> "Disc":
        """The same grain elsewhere."""
        return Disc(self.center + shift, self.radius)

    def box(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners of the box around it."""
        return self.center - self.radius, self.center + self.radius

    def distance(self, points: np.ndarray) -> np.ndarray:
        """Distance of points from the wall, negative inside of the grain."""
        return np.linalg.norm(points - self.center, axis=-1) - self.radius

    def area(self) -> float:
        """Its area."""
        return np.pi * self.radius**2

    def corners(self) -> np.ndarray:
        """It has none."""
        return np.empty((0, 2))

    def outline(self, size) -> tuple[np.ndarray, np.ndarray]:
        """Points around the wall as far from each other as `size` says, and the normals there."""
        angle = stations(lambda t: 2 * np.pi * self.radius / size(self.at(2 * np.pi * t)), least=12)
        normals = np.stack([np.cos(2 * np.pi * angle), np.sin(2 * np.pi * angle)], axis=-1)
        return self.center + self.radius * normals, normals / self.radius

    def at(self, angle: np.ndarray) -> np.ndarray:
        """Points of the wall."""
        return self.center + self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


@dataclass
class Polygon:
    """A grain with straight walls: its vertices in order."""

    vertices: np.ndarray

    def moved(self, shift: np.ndarray) -> "Polygon":
        """The same grain elsewhere."""
        return Polygon(self.vertices + shift)

    def box(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners of the box around it."""
        return self.vertices.min(axis=0), self.vertices.max(axis=0)

    def distance(self, points: np.ndarray) -> np.ndarray:
        """Distance of points from the wall, negative inside of the grain."""
        distance, inside = np.full(points.shape[:-1], np.inf), np.zeros(points.shape[:-1], bool)
        for a, b in zip(self.vertices, np.roll(self.vertices, -1, axis=0), strict=True):
            along = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
            distance = np.minimum(distance, np.linalg.norm(points - a - along[..., None] * (b - a), axis=-1))
            crosses = (a[1] > points[..., 1]) != (b[1] > points[..., 1])
            with np.errstate(divide="ignore", invalid="ignore"):
                x = a[0] + (points[..., 1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
            inside ^= crosses & (points[..., 0] < x)
        return np.where(inside, -distance, distance)

    def area(self) -> float:
        """Its area."""
        x, y = self.vertices.T
        return abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2

    def corners(self) -> np.ndarray:
        """Its vertices."""
        return self.vertices

    def outline(self, size) -> tuple[np.ndarray, np.ndarray]:
        """Points around the wall as far from each other as `size` says; straight walls need no normals."""
        parts = []
        for a, b in zip(self.vertices, np.roll(self.vertices, -1, axis=0), strict=True):
            along = stations(lambda t, a=a, b=b: np.linalg.norm(b - a) / size(a + t[:, None] * (b - a)), least=2)
            parts.append(a + along[:, None] * (b - a))
        points = np.concatenate(parts)
        return points, np.zeros_like(points)


def stations(density, least: int) -> np.ndarray:
    """Values in [0, 1), from 0 on, so that the density integrates to one from each to the next."""
    t = np.linspace(0, 1, 4001)
    value = density(t)
    total = np.concatenate([[0], np.cumsum((value[1:] + value[:-1]) / 2) / 4000])
    count = max(least, int(np.ceil(total[-1])))
    return np.interp(np.arange(count) / count * total[-1], total, t)


@dataclass
class Domain:
    """Grains in a box; `sides` says per axis how the box ends: periodic, wall or open."""

    low: np.ndarray
    high: np.ndarray
    grains: list
    sides: tuple[str, str]

    def __post_init__(self):
        """Finds the images of grains that a point of the box may be close to."""
        self.period = self.high - self.low
        self.images = []
        steps = [(-1, 0, 1) if side == "periodic" else (0,) for side in self.sides]
        for grain, *step in itertools.product(self.grains, *steps):
            image = grain.moved(np.array(step) * self.period)
            low, high = image.box()
            # Within a third of the box around it: what is farther away is no neighbor of a gap in it.
            if np.all(high > self.low - self.period / 3) and np.all(low < self.high + self.period / 3):
                self.images.append(image)

    def pore_area(self) -> float:
        """Area between the grains."""
        return float(np.prod(self.period)) - sum(grain.area() for grain in self.grains)

    def distances(self, points: np.ndarray) -> np.ndarray:
        """The two smallest distances from walls."""
        best = np.full((2, len(points)), np.inf)
        walls = [image.distance(points) for image in self.images]
        for axis in (a for a in (0, 1) if self.sides[a] == "wall"):
            walls += [points[:, axis] - self.low[axis], self.high[axis] - points[:, axis]]
        for distance in walls:
            best[1] = np.minimum(best[1], np.maximum(best[0], distance))
            best[0] = np.minimum(best[0], distance)
        return best

    def size(self, points: np.ndarray, across: float) -> np.ndarray:
        """Length of edges at points: a share of the gap."""
        size = np.minimum(self.distances(points).sum(axis=0) / across, self.period.min() / 8)
        corners = [image.corners() for image in self.images]
        base = size
        for corner in np.concatenate(corners) if corners else []:
            size = np.minimum(size, GROWTH * np.linalg.norm(points - corner, axis=1) + CORNER * base)
        return size


@dataclass
class Mesh:
    """Triangles of six nodes: three corners, then the middles of the edges opposite to them."""

    # Node numbers of each triangle; corners are numbered first.
    nodes: np.ndarray
    # Positions of these nodes in one frame per triangle.
    positions: np.ndarray
    corners: int
    count: int
    # Whether a node is on a wall.
    is_wall: np.ndarray


def mesh(domain: Domain, across: float, seed: int = 0) -> Mesh:
    """The mesh with about `across` edges across each gap."""
    fixed, normals, labels = outlines(domain, across)
    free = quadtree(domain, across, np.random.default_rng(seed))
    points = np.concatenate([fixed, free])
    size = domain.size(points, across)
    for _ in range(25):
        triangles, frame = pore_triangles(domain, points)
        points[len(fixed) :] += springs(points, size, triangles, frame)[len(fixed) :]
        moved = points[len(fixed) :]
        for axis in (a for a in (0, 1) if domain.sides[a] == "periodic"):
            moved[:, axis] = domain.low[axis] + (moved[:, axis] - domain.low[axis]) % domain.period[axis]
        now = domain.size(moved, across)
        kept = room(domain, moved, now)
        points = np.concatenate([fixed, moved[kept]])
        size = np.concatenate([size[: len(fixed)], now[kept]])
    labels = np.concatenate([labels, np.full(len(points) - len(fixed), INSIDE)])
    normals = np.concatenate([normals, np.zeros((len(points) - len(fixed), 2))])
    triangles, frame = pore_triangles(domain, points)
    return quadratic(domain, points, triangles, frame, labels, normals)


def outlines(domain: Domain, across: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points on all walls and open sides, normals over radii on round ones, and to what each point belongs."""

    def size(points):
        return domain.size(points, across)

    parts = []
    for index, grain in enumerate(domain.grains):
        points, normals = grain.outline(size)
        for axis in (0, 1):
            if domain.sides[axis] == "periodic":
                points[:, axis] = domain.low[axis] + (points[:, axis] - domain.low[axis]) % domain.period[axis]
            elif np.any((points[:, axis] < domain.low[axis]) | (points[:, axis] > domain.high[axis])):
                raise ValueError(f"grain {index} crosses a side that is not periodic")
        parts.append((points, normals, np.full(len(points), index)))
    wall = len(domain.grains)
    for axis in (a for a in (0, 1) if domain.sides[a] != "periodic"):
        other = 1 - axis
        for end in (domain.low[axis], domain.high[axis]):
            a, b = domain.low.copy(), domain.high.copy()
            a[axis] = b[axis] = end
            along = stations(lambda t, a=a, b=b: np.linalg.norm(b - a) / size(a + t[:, None] * (b - a)), least=4)
            if domain.sides[other] != "periodic":
                # Ends are corners of the box; both sides that meet there make them, once.
                along = np.append(along, 1.0) if axis == 0 else along[1:]
            points = a + along[:, None] * (b - a)
            is_wall = domain.sides[axis] == "wall"
            label = np.full(len(points), wall if is_wall else OPEN)
            if axis == 0 and domain.sides[other] == "wall":
                label[[0, -1]] = wall
            parts.append((points, np.zeros_like(points), label))
    return tuple(np.concatenate(column) for column in zip(*parts, strict=True))


def room(domain: Domain, points: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Which points are in the box and far enough from its walls for an edge."""
    inside = domain.distances(points)[0] > 0.4 * size
    for axis in (a for a in (0, 1) if domain.sides[a] == "open"):
        depth = np.minimum(points[:, axis] - domain.low[axis], domain.high[axis] - points[:, axis])
        inside &= depth > 0.4 * size
    return inside


def quadtree(domain: Domain, across: float, random: np.random.Generator) -> np.ndarray:
    """Centers of cells that are split until they are as small as edges are to be."""
    side = domain.period.min() / 4
    counts = np.ceil(domain.period / side).astype(int)
    steps = domain.period / counts
    centers = np.stack(np.meshgrid(*(np.arange(n) + 0.5 for n in counts), indexing="ij"), axis=-1).reshape(-1, 2)
    centers = domain.low + centers * steps
    done = []
    while len(centers):
        size = domain.size(centers, across)
        # Within a grain the distance is negative; what is farther inside than a cell has no pore in it.
        near = domain.distances(centers)[0] > -np.hypot(*steps)
        small = (steps.max() <= 1.2 * size) & near
        small &= room(domain, centers, size)
        done.append(centers[small])
        split = near & (steps.max() > 1.2 * np.maximum(size, 1e-4 * domain.period.min()))
        steps = steps / 2
        offsets = np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]]) * steps / 2
        centers = (centers[split][:, None] + offsets).reshape(-1, 2)
    points = np.concatenate(done)
    size = domain.size(points, across)
    return points + random.uniform(-0.1, 0.1, points.shape) * size[:, None]


def pore_triangles(domain: Domain, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Delaunay's triangles between the grains: numbers of their corners, and their places in one frame per triangle.

    Along periodic axes images of points lie around the box, and of all images of a triangle that one is taken whose
    corner of the smallest number is in the box.
    """
    margin = domain.period / 4
    images, base = [points], [np.arange(len(points))]
    steps = [(-1, 0, 1) if side == "periodic" else (0,) for side in domain.sides]
    for step in itertools.product(*steps):
        if any(step):
            moved = points + np.array(step) * domain.period
            near = np.all((moved > domain.low - margin) & (moved < domain.high + margin), axis=1)
            images.append(moved[near])
            base.append(np.flatnonzero(near))
    everywhere, base = np.concatenate(images), np.concatenate(base)
    found = Delaunay(everywhere).simplices
    first = found[np.arange(len(found)), np.argmin(base[found], axis=1)]
    found = found[first < len(points)]
    frame = everywhere[found]
    pore = domain.distances(frame.mean(axis=1))[0] > 0
    return base[found[pore]], frame[pore]


def springs(points: np.ndarray, size: np.ndarray, triangles: np.ndarray, frame: np.ndarray) -> np.ndarray:
    """How far springs of the lengths that edges are to have push the points."""
    pairs = [(0, 1), (1, 2), (2, 0)]
    edge = np.concatenate([frame[:, b] - frame[:, a] for a, b in pairs])
    start = np.concatenate([triangles[:, a] for a, _ in pairs])
    end = np.concatenate([triangles[:, b] for _, b in pairs])
    length = np.linalg.norm(edge, axis=1)
    wanted = (size[start] + size[end]) / 2
    wanted *= 1.2 * np.sqrt(np.sum(length**2) / np.sum(wanted**2))
    # Each edge stands in two triangles.
    push = 0.1 * (np.maximum(wanted - length, 0) / length)[:, None] * edge
    total = np.zeros_like(points)
    np.add.at(total, end, push)
    np.add.at(total, start, -push)
    step = np.linalg.norm(total, axis=1)
    return total * (np.minimum(step, 0.3 * size) / np.maximum(step, 1e-300))[:, None]


def quadratic(domain: Domain, points, triangles, frame, labels, normals) -> Mesh:
    """Triangles of six nodes from those of three; the area is checked."""
    (ax, ay), (bx, by) = (frame[:, 1] - frame[:, 0]).T, (frame[:, 2] - frame[:, 0]).T
    flip = ax * by - ay * bx < 0
    triangles[flip], frame[flip] = triangles[flip][:, [0, 2, 1]], frame[flip][:, [0, 2, 1]]
    opposite = [(1, 2), (2, 0), (0, 1)]
    start = np.stack([triangles[:, a] for a, _ in opposite], axis=1)
    end = np.stack([triangles[:, b] for _, b in opposite], axis=1)
    middle = np.stack([(frame[:, a] + frame[:, b]) / 2 for a, b in opposite], axis=1)
    # An edge is known by its ends and by the number of periods between them.
    low, high = np.minimum(start, end), np.maximum(start, end)
    vector = np.stack([frame[:, b] - frame[:, a] for a, b in opposite], axis=1)
    vector = np.where((start < end)[..., None], vector, -vector)
    shift = np.rint((vector - (points[high] - points[low])) / domain.period).astype(int)
    key = np.concatenate([low[..., None], high[..., None], shift], axis=2).reshape(-1, 4)
    _, number, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
    number = number.reshape(start.shape)
    if count.max() > 2:
        raise ValueError("the mesh is too coarse for the period: take more elements across")
    boundary = count[number] == 1
    on_grain = boundary & (labels[start] == labels[end]) & (labels[start] >= 0)
    is_open = boundary & ((labels[start] == OPEN) | (labels[end] == OPEN))
    if np.any(boundary & ~on_grain & ~is_open):
        raise ValueError("the mesh does not keep the walls: take more elements across")
    # Round walls: the middle of two normals from the center, in the frame of the edge's first end.
    curvature = np.linalg.norm(normals[start], axis=2)
    is_round = on_grain & (curvature > 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        first = np.stack([frame[:, a] for a, _ in opposite], axis=1)
        both = normals[start] + normals[end]
        radius = 1 / curvature[..., None]
        center = first - normals[start] * radius**2
        on_circle = center + radius * both / np.linalg.norm(both, axis=2)[..., None]
    middle = np.where(is_round[..., None], on_circle, middle)
    nodes = np.concatenate([triangles, len(points) + number], axis=1)
    is_wall = np.zeros(len(points) + number.max() + 1, bool)
    is_wall[: len(points)] = labels >= 0
    is_wall[len(points) + number[on_grain]] = True
    made = Mesh(nodes, np.concatenate([frame, middle], axis=1), len(points), len(is_wall), is_wall)
    # Six nodes follow a circle to the fourth order of the edge.
    area = sum(float(np.sum(weight)) for weight, *_ in quadrature(made))
    if abs(area / domain.pore_area() - 1) > 1e-3:
        raise ValueError(f"the mesh has an area of {area:.6g}, the pore space {domain.pore_area():.6g}: more elements")
    return made


def quadrature(made: Mesh):
    """For each of seven points: weight in the area, shape functions of six and three nodes, gradients of the former."""
    root = np.sqrt(15)
    a, b = (6 - root) / 21, (6 + root) / 21
    rule = [((1 / 3, 1 / 3), 9 / 80)]
    rule += [(point, (155 - root) / 2400) for point in [(a, a), (1 - 2 * a, a), (a, 1 - 2 * a)]]
    rule += [(point, (155 + root) / 2400) for point in [(b, b), (1 - 2 * b, b), (b, 1 - 2 * b)]]
    for (x, y), weight in rule:
        corner = np.array([1 - x - y, x, y])
        slope = np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
        i, j = np.array([1, 2, 0]), np.array([2, 0, 1])
        value = np.concatenate([corner * (2 * corner - 1), 4 * corner[i] * corner[j]])
        of_corner = (4 * corner - 1)[:, None] * slope
        of_middle = 4 * (corner[i][:, None] * slope[j] + corner[j][:, None] * slope[i])
        gradient = np.concatenate([of_corner, of_middle])
        jacobian = np.einsum("mna,nb->mab", made.positions, gradient)
        determinant = jacobian[:, 0, 0] * jacobian[:, 1, 1] - jacobian[:, 0, 1] * jacobian[:, 1, 0]
        inverse = np.stack([jacobian[:, 1, 1], -jacobian[:, 0, 1], -jacobian[:, 1, 0], jacobian[:, 0, 0]], axis=1)
        inverse = inverse.reshape(-1, 2, 2) / determinant[:, None, None]
        yield weight * determinant, value, corner, np.einsum("nb,mba->mna", gradient, inverse)
