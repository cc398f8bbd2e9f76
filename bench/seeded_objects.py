"""Objects made by rules from a seed, in mm: y up, standing on y = 0. Their meshes are closed,
2-manifold, oriented outwards and without self-intersections by construction: outlines turned about
the axis (lathe), or the zero set of a function on a grid (surface_of).

    make(KIND, SEED) gives vertices and triangles, for each KIND of KINDS.
"""
import itertools
import math
import random

import numpy as np

CELLS = 6e5  # of a grid


# Meshes

def volume_of(vertices, triangles):
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return float(np.einsum('ij,ij->', a, np.cross(b, c)) / 6.0)


def lathe(outline, around, radius=None):
    """An outline of (r, y) turned about the axis: from the axis to the axis, or a ring that does not
    touch it. radius(angle, r, y): the radius there instead of r; each half-plane keeps an outline
    that does not cross itself."""
    outline = np.asarray(outline, float)
    outline = outline[np.r_[True, np.any(np.diff(outline, axis=0) != 0.0, axis=1)]]
    r, y = outline[:, :1], outline[:, 1:]
    angle = 2.0 * np.pi * np.arange(around)[None, :] / around
    reach = r + 0.0 * angle if radius is None else radius(angle, r, y)
    on_axis = r[:, 0] == 0.0
    corner = np.where(on_axis[:, None], np.arange(around)[None, :] * 0, np.arange(around)[None, :])
    corner = corner + around * np.arange(len(outline))[:, None]
    points = np.stack(np.broadcast_arrays(reach * np.cos(angle), y, -reach * np.sin(angle)), axis=2)
    here, above = corner, np.roll(corner, -1, axis=0)
    if on_axis[0]:
        here, above = here[:-1], above[:-1]
    a, b, c, d = here, np.roll(here, -1, axis=1), np.roll(above, -1, axis=1), above
    faces = np.concatenate([np.stack(t, axis=2).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])]
    used, faces = np.unique(faces, return_inverse=True)
    return points.reshape(-1, 3)[used], faces.reshape(-1, 3)


def surface_of(distance, low, high):
    """Where distance(x, y, z) is 0, in a box that has it all, by marching tetrahedra: a function that
    is linear in each has a zero set without gaps or crossings."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    pitch = (np.prod(high - low) / CELLS) ** (1.0 / 3.0)
    shape = np.ceil((high - low) / pitch).astype(int) + 3
    axes = [low[k] + pitch * (np.arange(shape[k]) - 1.0) for k in range(3)]
    values = distance(axes[0][:, None, None], axes[1][None, :, None], axes[2][None, None, :])
    values = np.broadcast_to(values, shape)
    # Away from 0, so that no triangle is without area.
    values = np.where(values < 0.0, -1.0, 1.0) * np.maximum(np.abs(values), 0.05 * pitch)
    for k in range(3):
        for end in (0, -1):
            np.moveaxis(values, k, 0)[end] = np.maximum(np.moveaxis(values, k, 0)[end], pitch)
    inside = values < 0.0
    step = np.array([shape[1] * shape[2], shape[2], 1])
    whole = tuple(slice(0, n - 1) for n in shape)
    corners = list(itertools.product((0, 1), repeat=3))
    count = sum(inside[tuple(slice(c, n - 1 + c) for c, n in zip(corner, shape))].astype(np.int8)
                for corner in corners)
    first = np.ravel_multi_index(np.nonzero((count > 0) & (count < 8)), inside[whole].shape)
    first = np.ravel_multi_index(np.unravel_index(first, inside[whole].shape), shape)
    # Each cube is six tetrahedra about its diagonal, alike in all cubes.
    tetrahedra = np.concatenate([first[:, None] + np.cumsum([0, *step[list(way)]])
                                 for way in itertools.permutations(range(3))])
    flat, is_in = values.ravel(), inside.ravel()
    order = np.argsort(~is_in[tetrahedra], axis=1, kind='stable')  # those inside first
    tetrahedra = np.take_along_axis(tetrahedra, order, axis=1)
    within = is_in[tetrahedra].sum(axis=1)
    edges, inner = [], []
    for number, triangles in ((1, [(0, 1, 0, 2, 0, 3)]), (3, [(0, 3, 1, 3, 2, 3)]),
                              (2, [(0, 2, 0, 3, 1, 3), (0, 2, 1, 3, 1, 2)])):
        of = tetrahedra[within == number]
        for ends in triangles:
            edges.append(of[:, list(ends)].reshape(-1, 3, 2))
            inner.append(of[:, [0, -1]])
    edges, inner = np.concatenate(edges), np.concatenate(inner)
    used, faces = np.unique(np.sort(edges, axis=2).reshape(-1, 2) @ [len(flat), 1], return_inverse=True)
    faces = faces.reshape(-1, 3)
    ends = np.stack([used // len(flat), used % len(flat)])
    at = np.stack([axes[k][np.stack(np.unravel_index(ends, shape))[k]] for k in range(3)], axis=2)
    share = (flat[ends[0]] / (flat[ends[0]] - flat[ends[1]]))[:, None]
    vertices = at[0] + share * (at[1] - at[0])
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    outwards = np.stack([axes[k][np.stack(np.unravel_index(inner, shape))[k]] for k in range(3)], axis=2)
    flip = np.einsum('ij,ij->i', np.cross(b - a, c - a), outwards[:, 1] - outwards[:, 0]) < 0.0
    faces[flip] = faces[flip][:, ::-1]
    return vertices, faces


# Distances

def blend(a, b, width):
    """Of two bodies that run into each other over this width."""
    h = np.maximum(width - np.abs(a - b), 0.0) / width
    return np.minimum(a, b) - 0.25 * width * h * h


def limb(p, a, b, thick_a, thick_b):
    """A capsule from a to b, of radii that change evenly."""
    way = np.subtract(b, a)
    off = [p[k] - a[k] for k in range(3)]
    t = np.clip(sum(off[k] * way[k] for k in range(3)) / float(way @ way), 0.0, 1.0)
    return np.sqrt(sum((off[k] - t * way[k]) ** 2 for k in range(3))) - (thick_a + t * (thick_b - thick_a))


def cuboid(p, middle, half):
    return np.maximum.reduce(np.broadcast_arrays(
        *[np.abs(p[k] - middle[k]) - half[k] for k in range(3)]))


def rod(p, axis, middle, radius):
    """A cylinder without ends."""
    a, b = [k for k in range(3) if k != axis]
    return np.hypot(p[a] - middle[a], p[b] - middle[b]) - radius


def turned(p, ys, rs):
    """A turned body, its steps a little rounded."""
    at = np.linspace(0.0, ys[-1], 400)
    radius = np.convolve(np.pad(np.interp(at, ys, rs), 4, 'edge'), np.full(9, 1.0 / 9.0), 'valid')
    steep = np.interp(p[1], at, np.hypot(1.0, np.gradient(radius, at)))
    side = (np.hypot(p[0], p[2]) - np.interp(p[1], at, radius)) / steep
    return np.maximum(side, np.abs(p[1] - 0.5 * ys[-1]) - 0.5 * ys[-1])


# Outlines

def beads(rng, height, narrow, wide, sections):
    """Heights and radii of something turned: a foot, then beads, coves, cones and steps."""
    ys, rs = [0.0, 0.03 * height], [wide, wide]
    ends = sorted(rng.uniform(0.08, 0.95) for _ in range(sections - 1)) + [1.0]
    at = rs[-1]
    for low, high in zip([0.03, *ends], ends):
        if high - low < 0.03:
            continue
        to, t = rng.uniform(narrow, 0.7 * wide + 0.3 * narrow), np.linspace(0.0, 1.0, 24)
        bulge = rng.choice([0.0, 1.0, -0.5]) * min(0.5 * (high - low) * height, narrow)
        ys.extend(height * (low + t * (high - low)))
        rs.extend(np.maximum(at + t * (to - at) + bulge * np.sin(np.pi * t), narrow))
        at = to * rng.choice([1.0, 1.0, 0.8])
    ys, rs = np.array(ys), np.array(rs)
    ys = np.maximum.accumulate(ys + 1e-3 * np.arange(len(ys)))
    return ys * (height / ys[-1]), np.maximum(rs, narrow)


def solid(ys, rs):
    return [(0.0, 0.0), *zip(rs, ys), (0.0, ys[-1])]


def hollow(ys, rs, wall, floor):
    """The same with an inside, open above."""
    inner_y = np.linspace(ys[-1], floor, 120)
    inner_r = np.interp(inner_y, ys, rs)
    steep = np.hypot(1.0, np.gradient(inner_r, inner_y))
    inner_r = np.maximum(inner_r - wall * np.minimum(steep, 3.0), 1.0)
    return [(0.0, 0.0), *zip(rs, ys), *zip(inner_r, inner_y), (0.0, floor)]


def through(points, height, steps=120):
    """Heights and radii, smooth through some radii at even heights."""
    x = np.linspace(0.0, 1.0, len(points))
    t = np.linspace(0.0, 1.0, steps)
    k = np.clip(np.searchsorted(x, t, side='right') - 1, 0, len(points) - 2)
    u = t * (len(points) - 1) - k
    padded = np.r_[2 * points[0] - points[1], points, 2 * points[-1] - points[-2]]
    p, q, r, s = (padded[k + j] for j in range(4))
    rs = q + 0.5 * u * (r - p + u * (2 * p - 5 * q + 4 * r - s + u * (3 * (q - r) + s - p)))  # Catmull-Rom
    return t * height, rs


# Kinds

def gear(rng):
    teeth, wide, height = rng.randint(20, 90), rng.uniform(60, 160), rng.uniform(15, 60)
    outer, deep = 0.5 * wide, 2.25 * wide / (teeth + 2)
    bore, hub = rng.uniform(4, 0.15 * wide), rng.uniform(0.2, 0.3) * wide
    rise = rng.choice([0.0, rng.uniform(3, 12), -0.3 * height])

    def radius(angle, r, y):
        phase = np.abs((teeth * angle / (2.0 * np.pi)) % 1.0 - 0.5)
        return r - np.where(r == outer, deep * np.clip(0.5 + 5.0 * (phase - 0.25), 0.0, 1.0), 0.0)
    outline = [(bore, 0), (outer, 0), (outer, height)]
    if rise > 0.0:
        outline += [(hub, height), (hub, height + rise), (bore, height + rise)]
    elif rise < 0.0:  # a web that is thinner than the rim
        inside = 0.85 * (outer - deep)
        hub = min(hub, 0.8 * inside)
        outline += [(inside, height), (inside, height + rise), (hub, height + rise), (hub, height), (bore, height)]
    else:
        outline += [(bore, height)]
    return lathe(outline, teeth * 12, radius)


def knob(rng):
    height, wide = rng.uniform(60, 90), rng.uniform(50, 110)
    turns, deep = rng.randint(24, 60), rng.uniform(0.5, 1.5)
    slant = rng.choice([0.0, math.pi * turns / wide])  # of the knurl's ridges: straight or crossed
    low, high, neck = 0.35 * height, 0.9 * height, rng.uniform(0.25, 0.45) * wide

    def radius(angle, r, y):
        ridge = np.abs(np.sin(0.5 * (turns * angle + slant * y)) * np.sin(0.5 * (turns * angle - slant * y)))
        return r - np.where((r > 0.49 * wide) & (y > low) & (y < high), deep * (1.0 - ridge), 0.0)
    grip = [(0.5 * wide, y) for y in np.linspace(low, high, 80)]
    outline = [(0, 0), (0.42 * wide, 0), (0.42 * wide, 0.08 * height), (neck, 0.15 * height),
               (neck, low - 3.0), *grip, (0.44 * wide, height), (0, height)]
    return lathe(outline, turns * 10, radius)


def column(rng):
    height, wide = rng.uniform(150, 300), rng.uniform(40, 80)
    flutes, deep, swell = rng.randint(10, 24), rng.uniform(1.0, 3.5), rng.uniform(0.0, 0.1)
    low, high = 0.15 * height, 0.85 * height

    def radius(angle, r, y):
        ends = np.clip(np.minimum(y - low, high - y) / 5.0, 0.0, 1.0)
        return r - ends * deep * np.maximum(0.0, np.cos(flutes * angle)) ** 0.5
    shaft = [(0.38 * wide * (1.0 - swell * t * t), low + t * (high - low)) for t in np.linspace(0, 1, 60)]
    base = [(0.5 * wide + 4 * math.sin(t), 0.08 * height + 0.06 * height * t / math.pi)
            for t in np.linspace(0, math.pi, 16)]
    top = [(0.4 * wide, 0.88 * height), (0.55 * wide, 0.94 * height), (0.55 * wide, height)]
    return lathe([(0, 0), (0.62 * wide, 0), (0.62 * wide, 0.08 * height), *base, *shaft, *top, (0, height)],
                 flutes * 16, radius)


def pawn(rng):
    height = rng.uniform(100, 250)
    ys, rs = beads(rng, 0.72 * height, 0.06 * height, rng.uniform(0.2, 0.28) * height, rng.randint(4, 7))
    ball = rng.uniform(0.13, 0.17) * height
    start = math.asin(min(rs[-1] / ball, 0.9))
    head = [(ball * math.sin(t), ys[-1] + ball * (math.cos(start) - math.cos(t)))
            for t in np.linspace(start, math.pi, 40)[1:-1]]
    return lathe([(0, 0), *zip(rs, ys), *head, (0, head[-1][1] + 0.02)], 200)


def candlestick(rng):
    height, hole = rng.uniform(120, 300), rng.uniform(10, 12)
    ys, rs = beads(rng, 0.85 * height, rng.uniform(6, 10), rng.uniform(0.17, 0.3) * height, rng.randint(5, 9))
    cup = rng.uniform(hole + 3, hole + 18)
    outline = [(0, 0), *zip(rs, ys), (cup, 0.88 * height), (cup, 0.9 * height), (hole + 2.5, 0.91 * height),
               (hole + 2.5, height), (hole, height), (hole, 0.92 * height), (0, 0.92 * height)]
    return lathe(outline, 200)


def bottle(rng):
    height, wide = rng.uniform(150, 300), rng.uniform(0.14, 0.2)
    wide, neck = wide * height, rng.uniform(11, 15)
    shoulder, lip = rng.uniform(0.5, 0.7), rng.uniform(1.5, 4)
    t = np.linspace(0.0, 1.0, 50)
    ys = np.r_[0, 3, shoulder + t * (0.82 - shoulder), 0.93, 0.93 + 1e-4, 1.0] * height
    ys[1] = 3.0
    rs = np.r_[wide - 3, wide, wide + (neck - wide) * (t * t * (3 - 2 * t)), neck, neck + lip, neck + lip]
    deep = rng.uniform(0.03, 0.1) * height
    hole = neck - 3.0
    flat = rng.choice([1.0, 1.0, 0.6])  # seen from above: round, or longish
    vertices, faces = lathe([(0, 0), *zip(rs, ys), (hole, height), (hole, height - deep), (0, height - deep)], 200)
    return vertices * [1.0, 1.0, flat], faces


def vase(rng):
    height, wide = rng.uniform(100, 250), rng.uniform(0.25, 0.38)
    points = wide * height * np.array([rng.uniform(a, b) for a, b in
                                       ((0.5, 0.7), (0.7, 1), (0.8, 1), (0.45, 0.8), (0.5, 0.9))])
    ys, rs = through(points, height)
    wall = rng.uniform(3, 6)
    ribs, deep = rng.randint(6, 20), rng.choice([0.0, rng.uniform(0.01, 0.05)])
    return lathe(hollow(ys, rs, wall, 1.5 * wall), 240,
                 lambda angle, r, y: r * (1.0 + deep * np.sin(ribs * angle)))


def bowl(rng):
    height, wide = rng.uniform(60, 100), rng.uniform(50, 95)
    foot, bend = rng.uniform(0.35, 0.55), rng.uniform(0.35, 0.7)
    t = np.linspace(0.0, 1.0, 100)
    wall = rng.uniform(3, 6)
    return lathe(hollow(t * height, wide * (foot + (1 - foot) * t ** bend), wall, 2 * wall), 200)


def square(angle, r, y):
    return r / np.maximum(np.abs(np.cos(angle)), np.abs(np.sin(angle)))


def open_box(rng):
    """Without a lid."""
    height, wall = rng.uniform(60, 140), rng.uniform(2.5, 6)
    half = rng.uniform(35, 70)
    outline = [(0, 0), (half, 0), (half, height), (half - wall, height), (half - wall, wall), (0, wall)]
    vertices, faces = lathe(outline, 8, square)
    return vertices * [1.0, 1.0, rng.uniform(0.6, 1.0)], faces


def holes(rng):
    """A box with holes through it."""
    half = [rng.uniform(25, 70), 0.5 * rng.uniform(60, 160), rng.uniform(25, 60)]
    drills = []
    for _ in range(rng.randint(2, 5)):
        axis = rng.randrange(3)
        across = [k for k in range(3) if k != axis]
        radius = rng.uniform(0.12, 0.45) * min(half[k] for k in across)
        middle = [0.0, half[1], 0.0]
        for k in across:
            middle[k] += rng.uniform(-1, 1) * (half[k] - radius - 5.0)
        drills.append((axis, middle, radius))

    def distance(*p):
        out = cuboid(p, (0.0, half[1], 0.0), half)
        for drill in drills:
            out = np.maximum(out, -rod(p, *drill))
        return out
    return surface_of(distance, (-half[0], 0, -half[2]), (half[0], 2 * half[1], half[2]))


def mug(rng):
    height, wide, wall = rng.uniform(80, 120), rng.uniform(35, 48), rng.uniform(3.5, 6)
    cone, thick = rng.uniform(-0.1, 0.15), rng.uniform(4, 7)
    low, high, out = 0.2 * height, 0.8 * height, rng.uniform(24, 34)
    bows = [(wide + out * math.sin(t) - 2.0, 0.5 * (low + high) - 0.5 * (high - low) * math.cos(t), 0.0)
            for t in np.linspace(0.0, math.pi, 12)]

    def distance(*p):
        r = np.hypot(p[0], p[2])
        side = wide * (1.0 + cone * (p[1] / height - 0.5))
        cup = np.maximum(r - side, np.abs(p[1] - 0.5 * height) - 0.5 * height)
        handle = np.minimum.reduce([limb(p, a, b, thick, thick) for a, b in zip(bows, bows[1:])])
        return np.maximum(blend(cup, handle, 5.0), -np.maximum(r - side + wall, wall - p[1]))
    reach = 1.1 * wide
    return surface_of(distance, (-reach, 0, -reach), (wide + out + thick + 1, height, reach))


def chain(rng):
    """Links that touch where they hang in each other, upright or lying."""
    count, wire = rng.randint(3, 5), rng.uniform(5, 8)
    bend, straight = wire * rng.uniform(2.3, 2.8), wire * rng.uniform(0.5, 1.5)
    lying = rng.random() < 0.4
    first = math.pi / 4 if lying else 0.0
    apart = 2.0 * (straight + bend) - 1.7 * wire
    across = bend + wire
    stands = math.sqrt(0.5) * bend + wire - 1.0 if lying else straight + bend + wire - 2.0

    def distance(*p):
        x, y, z = p
        along, side, up = (x + 0.5 * apart * (count - 1), z, y - stands) if lying else (y - stands, x, z)
        out = None
        for i in range(count):
            turn = first + 0.5 * math.pi * i
            u = np.maximum(np.abs(along - i * apart) - straight, 0.0)
            v = math.cos(turn) * side + math.sin(turn) * up
            w = math.cos(turn) * up - math.sin(turn) * side
            link = np.hypot(np.hypot(u, v) - bend, w) - wire
            out = link if out is None else blend(out, link, 2.0)
        return np.maximum(out, -y)
    length = apart * (count - 1) + 2 * (straight + bend + wire)
    if lying:
        return surface_of(distance, (-0.5 * length, 0, -across), (0.5 * length, 2 * across, across))
    return surface_of(distance, (-across, 0, -across), (across, length, across))


def arc(x, y, rx, ry, start, end):
    return [(x + rx * math.cos(t), y + ry * math.sin(t)) for t in np.radians(np.linspace(start, end, 14))]


LETTERS = {
    'E': [[(0.7, 0), (0, 0), (0, 1), (0.7, 1)], [(0, 0.5), (0.55, 0.5)]],
    'H': [[(0, 0), (0, 1)], [(0.7, 0), (0.7, 1)], [(0, 0.5), (0.7, 0.5)]],
    'K': [[(0, 0), (0, 1)], [(0.7, 1), (0, 0.45)], [(0.2, 0.6), (0.7, 0)]],
    'M': [[(0, 0), (0, 1), (0.4, 0.4), (0.8, 1), (0.8, 0)]],
    'N': [[(0, 0), (0, 1), (0.7, 0), (0.7, 1)]],
    'P': [[(0, 0), (0, 1), (0.3, 1), *arc(0.35, 0.72, 0.3, 0.28, 90, -90), (0, 0.44)]],
    'R': [[(0, 0), (0, 1), (0.3, 1), *arc(0.35, 0.72, 0.3, 0.28, 90, -90), (0, 0.44)], [(0.3, 0.44), (0.7, 0)]],
    'S': [[*arc(0.35, 0.76, 0.33, 0.24, 20, 270), *arc(0.35, 0.26, 0.35, 0.26, 90, -160)]],
    'U': [[(0, 1), *arc(0.35, 0.3, 0.35, 0.3, 180, 360), (0.7, 1)]],
    'X': [[(0, 0), (0.7, 1)], [(0, 1), (0.7, 0)]],
    'Z': [[(0, 1), (0.7, 1), (0, 0), (0.7, 0)]],
}


def letter(rng):
    lines = LETTERS[rng.choice(sorted(LETTERS))]
    height, half, deep = rng.uniform(80, 220), rng.uniform(0.06, 0.1), rng.uniform(7, 25)
    half *= height
    scale = height - 2 * half
    edges = [(np.array(a) * scale, np.array(b) * scale) for line in lines for a, b in zip(line, line[1:])]
    middle = 0.35 * scale

    def distance(x, y, z):
        flat = np.minimum.reduce([limb((x + middle, y - half + 1.0, 0.0), (*a, 0.0), (*b, 0.0), half, half)
                                  for a, b in edges])
        return np.maximum(np.maximum(flat, np.abs(z) - deep), -y)
    return surface_of(distance, (-middle - half, 0, -deep), (0.85 * scale - middle + half, height, deep))


def knight(rng):
    """A head looking to one side, on a narrow turned pedestal."""
    height = rng.uniform(130, 220)
    s = height / 180.0
    ys, rs = beads(rng, 0.4 * height, rng.uniform(12, 16) * s, rng.uniform(28, 36) * s, rng.randint(3, 6))
    lean, snout = rng.uniform(6, 16) * s, rng.uniform(30, 40) * s
    top = height - rng.uniform(14, 20) * s

    def distance(*p):
        neck = limb(p, (-0.3 * lean, ys[-1] - 4 * s, 0), (-lean, 0.72 * top, 0), 17 * s, 16 * s)
        crown = limb(p, (-lean, 0.72 * top, 0), (0, top - 14 * s, 0), 16 * s, 14 * s)
        face = limb(p, (0, top - 14 * s, 0), (snout, top - 34 * s, 0), 13 * s, 8.5 * s)
        out = blend(blend(neck, crown, 8 * s), face, 8 * s)
        for side in (-1.0, 1.0):
            ear = limb(p, (-3 * s, top - 6 * s, 6 * s * side), (-6 * s, height - 4 * s, 8 * s * side), 5 * s, 3 * s)
            eye = limb(p, (10 * s, top - 12 * s, 11 * s * side), (12 * s, top - 13 * s, 11 * s * side), 3 * s, 3 * s)
            out = np.minimum(blend(out, ear, 3 * s), eye)
        for k in range(5):  # the mane
            t = k / 4.0
            at = (-lean - 15 * s + 8 * s * t, 0.55 * top + 0.38 * t * top, 0.0)
            out = blend(out, limb(p, (at[0], at[1], -2 * s), (at[0], at[1], 2 * s), 6 * s, 6 * s), 2 * s)
        return blend(out, turned(p, ys, rs), 3 * s)
    side = max(rs[0], 30 * s) + 3
    return surface_of(distance, (-side - lean, 0, -side), (max(side, snout + 12 * s), height, side))


def animal(rng):
    """A body on four legs, with neck, head, ears and tail."""
    height, long = rng.uniform(80, 200), rng.uniform(0.8, 1.3)
    long *= height
    leg, thick = rng.uniform(0.3, 0.45) * height, rng.uniform(0.13, 0.2) * height
    chest, foot = leg + 0.6 * thick, rng.uniform(0.045, 0.07) * height
    front, back = 0.32 * long, -0.32 * long
    head = (front + rng.uniform(0.1, 0.25) * long, height - 0.17 * height, rng.uniform(-0.1, 0.1) * height)
    size, snout = rng.uniform(0.1, 0.14) * height, rng.uniform(0.08, 0.2) * height
    tail = (back - rng.uniform(0.1, 0.25) * long, leg + rng.uniform(-0.1, 0.35) * height,
            rng.uniform(-0.1, 0.1) * height)
    steps = [rng.uniform(-0.08, 0.08) * long for _ in range(4)]

    def distance(*p):
        out = limb(p, (back, chest, 0), (front, chest + 0.03 * height, 0), 0.95 * thick, thick)
        out = blend(out, limb(p, (front, chest + 0.2 * thick, 0), head, 0.7 * thick, 0.7 * size), 0.1 * height)
        skull = limb(p, head, (head[0] + size + snout, head[1] - 0.5 * snout, head[2]), size, 0.55 * size)
        out = blend(out, skull, 0.06 * height)
        for k, (x, side) in enumerate(itertools.product((front, back), (-1.0, 1.0))):
            hip, toe = (x, chest, 0.5 * thick * side), (x + steps[k], 0.6 * foot, 0.8 * thick * side)
            out = blend(out, limb(p, hip, toe, 1.6 * foot, foot), 0.05 * height)
        out = blend(out, limb(p, (back, chest + 0.3 * thick, 0), tail, 0.06 * height, 0.03 * height), 0.05 * height)
        for side in (-1.0, 1.0):
            root = (head[0], head[1] + 0.8 * size, head[2] + 0.5 * size * side)
            tip = (root[0] - 0.02 * height, height - 0.02 * height, head[2] + 0.9 * size * side)
            out = blend(out, limb(p, root, tip, 0.025 * height, 0.02 * height), 0.02 * height)
        return np.maximum(out, -p[1])
    wide = max(1.2 * thick + 2 * foot, 0.2 * height + size)
    return surface_of(distance, (tail[0] - 0.15 * height, 0, -wide), (head[0] + 2 * size + snout, height + 5, wide))


KINDS = {f.__name__.replace('_', '-'): f for f in (
    gear, knob, column, pawn, candlestick, bottle, vase, bowl, open_box, holes, mug, chain, letter, knight, animal)}


def make(kind, seed):
    """Vertices in mm, triangles; the middle of its bounds on the axis."""
    vertices, triangles = KINDS[kind](random.Random(f'{kind} {seed}'))
    if volume_of(vertices, triangles) < 0.0:
        triangles = triangles[:, ::-1]
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return vertices - [0.5 * (low[0] + high[0]), low[1], 0.5 * (low[2] + high[2])], triangles


def write_ply(path, vertices, triangles):
    """Vertices in m."""
    faces = np.zeros(len(triangles), [('count', 'u1'), ('corners', '<i4', 3)])
    faces['count'], faces['corners'] = 3, triangles
    with open(path, 'wb') as file:
        file.write((f'ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n'
                    'property float x\nproperty float y\nproperty float z\n'
                    f'element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n').encode())
        file.write(np.asarray(vertices, '<f4').tobytes() + faces.tobytes())
