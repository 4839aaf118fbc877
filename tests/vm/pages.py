# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages: the kiosk's pages as `relievo --screenshots` draws them, with the places of their nodes; and how far a picture is from one."""
import json
import pathlib

import numpy
from PIL import Image

# As the goldens of tests/golden/pages are judged.
LEVELS = 16             # a pixel differs when one of its channels does by more
MOST_PIXELS = 0.001     # of the picture
MOST_OF_A_TILE = 0.1    # of 16 x 16 pixels


class Page:
    def __init__(self, stem):
        self.name = stem.name[3:]
        with Image.open(f"{stem}.png") as picture:
            self.picture = numpy.asarray(picture.convert("RGB"))
        self.nodes = {node["id"]: node for node in json.loads(pathlib.Path(f"{stem}.json").read_text()) if node["id"]}

    def middle(self, node):
        place = self.nodes[node]
        return place["x"] + place["w"] / 2, place["y"] + place["h"] / 2

    def part(self, picture, node):
        """The pixels of a node in a picture of this page's size."""
        place = self.nodes[node]
        return picture[place["y"]:place["y"] + place["h"], place["x"]:place["x"] + place["w"]]

    def difference(self, seen, without=(), only=()):
        """None: the same page, but for the nodes that show something of their own (or as far as the nodes in `only` go).
        Otherwise what differs, in words."""
        if seen.shape != self.picture.shape:
            return f"{seen.shape[1]}x{seen.shape[0]} instead of {self.picture.shape[1]}x{self.picture.shape[0]}"
        counts = numpy.full(seen.shape[:2], not only)
        for node in (*without, *only):
            self.part(counts, node)[:] = bool(only)
        differs = different_pixels(seen, self.picture) & counts
        height, width = (side // 16 * 16 for side in differs.shape)
        tiles = differs[:height, :width].reshape(height // 16, 16, width // 16, 16).mean(axis=(1, 3))
        if differs.mean() <= MOST_PIXELS and tiles.max() <= MOST_OF_A_TILE:
            return None
        y, x = numpy.unravel_index(tiles.argmax(), tiles.shape)
        return f"{100 * differs.mean():.2f} % of the pixels differ, most around ({16 * x + 8}, {16 * y + 8})"


def different_pixels(one, other):
    return numpy.abs(one.astype(numpy.int16) - other).max(axis=2) > LEVELS


class Pages:
    """The pages of one size, in English, with text at 100 %."""

    def __init__(self, folder):
        self.pages = {page.name: page for page in (Page(file.with_suffix("")) for file in sorted(pathlib.Path(folder).glob("*.png")))}

    def __getitem__(self, name):
        return self.pages[name]
