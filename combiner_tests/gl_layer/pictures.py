"""The few picture files that these tests read and write, as NumPy arrays of rows, the first row on top."""
import struct
import zlib

import numpy


def read_pnm(path):
    """A binary PGM or PPM of 8 bits: height x width, or height x width x 3."""
    with open(path, "rb") as file:
        data = file.read()
    magic, size, _, pixels = data.split(b"\n", 3)
    width, height = map(int, size.split())
    shape = (height, width, 3) if magic == b"P6" else (height, width)
    return numpy.frombuffer(pixels, numpy.uint8).reshape(shape)


def write_png(path, pixels):
    """8-bit grey, RGB or RGBA."""
    height, width = pixels.shape[:2]
    channels = 1 if pixels.ndim == 2 else pixels.shape[2]
    rows = numpy.zeros((height, 1 + width * channels), numpy.uint8)
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes())) +
                   chunk(b"IEND", b""))


def read_png(path):
    """8-bit grey, RGB or RGBA, not interlaced."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    while at < len(data):
        length, name = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if name == b"IHDR":
            width, height, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and kind in (0, 2, 6) and not interlaced, f"{path}: an unexpected kind of PNG"
        packed += body if name == b"IDAT" else b""
        at += 12 + length
    channels = {0: 1, 2: 3, 6: 4}[kind]
    raw = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).reshape(height, 1 + width * channels)
    out = numpy.zeros((height + 1, width + 1, channels), numpy.uint8)  # a row and a column of zeros before the picture
    for y in range(height):
        unfilter(raw[y, 0], raw[y, 1:].reshape(width, channels), out[y], out[y + 1])
    out = out[1:, 1:]
    return out[:, :, 0] if channels == 1 else out


def unfilter(kind, row, above, out):
    """One row of a PNG; `above` and `out` have a pixel of zeros before the first."""
    if kind in (0, 2):
        out[1:] = row + above[1:] if kind == 2 else row
        return
    if kind == 1:
        out[1:] = numpy.cumsum(row, axis=0, dtype=numpy.uint8)
        return
    channels = row.shape[1]
    flat, up, line = row.ravel().tolist(), above.ravel().tolist(), [0] * channels
    for i, value in enumerate(flat):
        left, over, corner = line[i], up[i + channels], up[i]
        if kind == 3:
            guess = (left + over) // 2
        else:
            p = left + over - corner
            near = [abs(p - left), abs(p - over), abs(p - corner)]
            guess = (left, over, corner)[near.index(min(near))]
        line.append((value + guess) & 255)
    out[:] = numpy.array(line, numpy.uint8).reshape(out.shape)


def read_xwd(path):
    """The screen of an X server that draws into a file: height x width x RGB, from 32 bits a pixel."""
    with open(path, "rb") as file:
        data = file.read()
    header = struct.unpack_from(">25I", data)
    width, height, row, colors = header[4], header[5], header[12], header[19]
    pixels = numpy.frombuffer(data, numpy.uint8, row * height, header[0] + 12 * colors).reshape(height, row)
    return pixels[:, :4 * width].reshape(height, width, 4)[:, :, 2::-1]


def read_layers(path):
    """The parts of the layers.exr that `ninebit render --layers` writes: {part: {channel: array}}. Scan lines, ZIP."""
    with open(path, "rb") as file:
        data = file.read()
    at, headers = 8, []

    def text():
        nonlocal at
        end = data.index(b"\0", at)
        found, at = data[at:end].decode(), end + 1
        return found

    while data[at]:
        attributes = {}
        while name := text():
            text()
            size, = struct.unpack_from("<i", data, at)
            attributes[name] = data[at + 4:at + 4 + size]
            at += 4 + size
        headers.append(attributes)
    at += 1
    at += 8 * sum(struct.unpack("<i", header["chunkCount"])[0] for header in headers)  # the offset tables

    parts = []
    for header in headers:
        assert header["compression"] == b"\3", f"{path}: an unexpected compression"
        left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
        channels, rest = {}, header["channels"]
        while rest[0]:
            name, rest = rest.split(b"\0", 1)
            channels[name.decode()] = numpy.zeros((bottom - top + 1, right - left + 1),
                                                  [numpy.uint32, numpy.float16][struct.unpack_from("<i", rest)[0]])
            rest = rest[16:]
        parts.append((header["name"].decode(), channels))
    while at < len(data):
        part, y, size = struct.unpack_from("<iii", data, at)
        read_chunk(data[at + 12:at + 12 + size], parts[part][1], y)
        at += 12 + size
    return dict(parts)


def read_chunk(packed, channels, top):
    """Up to 16 rows of one part, into its arrays."""
    height, width = next(iter(channels.values())).shape
    rows = min(16, height - top)
    size = rows * width * sum(plane.itemsize for plane in channels.values())
    if len(packed) == size:  # compression did not help
        raw = packed
    else:
        coded = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).copy()
        coded[1:] -= 128
        halves = numpy.cumsum(coded, dtype=numpy.uint8)  # each byte is the difference from the one before, plus 128
        spread = numpy.zeros(size, numpy.uint8)
        spread[0::2], spread[1::2] = halves[:(size + 1) // 2], halves[(size + 1) // 2:]
        raw = spread.tobytes()
    at = 0
    for y in range(top, top + rows):
        for plane in channels.values():  # in the order of their names, as the file has them
            end = at + width * plane.itemsize
            plane[y] = numpy.frombuffer(raw[at:end], plane.dtype)
            at = end
