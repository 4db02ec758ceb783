"""The letters of the pictures as a table, from the typeface: reads DejaVuSans.ttf, writes letters.bin beside it.

    pip install fonttools
    python make.py

crates/draw/src/typeface.rs reads the table; crates/draw/tests/typeface.rs compares it with the typeface.

A number is whole. Its sign becomes its lowest bit: 0, -1, 1, -2 are 0, 1, 2, 3. It takes bytes of seven bits, the lowest
first, of which all but the last have the eighth bit set. Lengths are in units of the typeface, y up. One after another:

    glyphs    their number, then of each its advance, the length of its outline in bytes and its outline
    letters   their number, then of each its code and its glyph, less those of the letter before
    pairs     their number, then of each its first glyph, less that of the pair before, its second, and what is added
              to the advance between them

An outline is of contours and parts. A contour is the number of its points, then of each twice its distance along x from
the point before, plus one if it lies on the curve, and its distance along y; the first point of a glyph is measured from
its origin. A part is a zero, a glyph, and the place of that glyph's origin. The last point of a contour lies on the curve
only if its first one does.
"""

from pathlib import Path

from fontTools.ttLib import TTFont

HERE = Path(__file__).parent


def number(value: int) -> bytes:
    """A number as bytes."""
    bits = 2 * value if value >= 0 else -2 * value - 1
    written = bytearray()
    while bits > 127:
        written.append(bits & 127 | 128)
        bits >>= 7
    return bytes([*written, bits])


def numbers(*values: int) -> bytes:
    """Numbers as bytes, one after another."""
    return b"".join(map(number, values))


def contours(coordinates, ends, on_curve):
    """Points of each contour, (x, y, whether it lies on the curve)."""
    start = 0
    for end in ends:
        points = [(x, y, on & 1) for (x, y), on in zip(coordinates[start : end + 1], on_curve[start : end + 1])]
        # A contour that begins beside its curve begins with its last point, where that one lies on it.
        if points[-1][2] and not points[0][2]:
            points = points[-1:] + points[:-1]
        yield points
        start = end + 1


def outline(font: TTFont, name: str) -> bytes:
    """Outline of a glyph as bytes; nothing for a space."""
    glyphs = font["glyf"]
    glyph = glyphs[name]
    if glyph.numberOfContours == 0:
        return b""
    # A few outlines stand a unit beside their bearing, which is what counts.
    shift = font["hmtx"][name][1] - glyph.xMin
    if glyph.isComposite():
        assert not any(hasattr(part, "transform") for part in glyph.components), name
        places = ((font.getGlyphID(part.glyphName), part.x + shift, part.y) for part in glyph.components)
        return b"".join(numbers(0, *place) for place in places)
    written = b""
    last = (-shift, 0)
    for points in contours(*glyph.getCoordinates(glyphs)):
        written += number(len(points))
        for x, y, on in points:
            written += numbers(2 * (x - last[0]) + on, y - last[1])
            last = (x, y)
    return written


def with_parts(font: TTFont, names: set) -> set:
    """Glyphs and the parts that they are made of."""
    glyphs = font["glyf"]
    parts = {part.glyphName for name in names if glyphs[name].isComposite() for part in glyphs[name].components}
    return names if parts <= names else with_parts(font, names | parts)


def table(font: TTFont) -> bytes:
    """The whole table: all letters of the typeface, and the glyphs that no letter needs empty."""
    order = font.getGlyphOrder()
    letters = sorted((code, font.getGlyphID(name)) for code, name in font.getBestCmap().items())
    used = with_parts(font, {".notdef"} | {order[glyph] for _, glyph in letters})
    written = number(len(order))
    for name in order:
        drawn = outline(font, name) if name in used else b""
        written += numbers(font["hmtx"][name][0] if name in used else 0, len(drawn)) + drawn
    written += number(len(letters))
    for (code, glyph), (code_before, glyph_before) in zip(letters, [(0, 0), *letters]):
        written += numbers(code - code_before, glyph - glyph_before)
    (kerning,) = font["kern"].kernTables
    pairs = sorted((*map(font.getGlyphID, pair), added) for pair, added in kerning.kernTable.items())
    written += number(len(pairs))
    for (first, second, added), (first_before, *_) in zip(pairs, [(0,), *pairs]):
        written += numbers(first - first_before, second, added)
    return written


if __name__ == "__main__":
    (HERE / "letters.bin").write_bytes(table(TTFont(HERE / "DejaVuSans.ttf")))
