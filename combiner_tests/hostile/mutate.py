"""Values and damage that every format shares: extreme numbers, names that reach elsewhere, bytes changed in place."""
import struct

BUDGET = 1 << 18  # bytes of a mutated file, about; so that a run takes some 20 ms

INTEGERS = [0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 31, 63, 64, 65, 127, 128, 255, 256, 257, 511, 512, 999, 1000, 4095, 4096,
            32767, 32768, 65535, 65536, 65537, 1000000, 2**24 - 1, 2**24, 2**24 + 1, 2**27, 2**28, 2**30, 2**31 - 1,
            2**31,
            2**32 - 2, 2**32 - 1, 2**32, 2**53, 2**62, 2**63 - 1, 2**63, 2**64 - 1, 2**64, 10**30]
NUMBERS = ["nan", "-nan", "NaN", "inf", "-inf", "Infinity", "1e308", "-1e308", "1e309", "1e39", "-3.5e38",
           "3.4028235e38",
           "1e-45", "1e-46", "1e-320", "1e-400", "0x10", "0x1p3", "1e", "1e+", "--1", "+1", "+.5", "5.", ".", "-", "-0",
           "-0.0",
           "00012", "1_000", "1,5", "\u0661", "1e0000000000000000000001", "0." + "0" * 500 + "1", "1" * 400, "1" * 5000,
           "9" * 19, "4294967296.5", "1.0000000000000000000000000000000000001", "1d", "1f", "0b1", "1/0"]
NAMES = ["", " ", ".", "..", "/", "-", "a", "a" * 63, "a" * 64, "a" * 255, "a" * 256, "a" * 1024, "a" * 4096,
         "a" * 70000,
         "../a", "../../../../../../etc/passwd", "/etc/passwd", "/dev/zero", "/dev/stdin", "/dev/full",
         "/proc/self/mem", "pipe",
         "folder", "folder/../pipe", "file:///etc/passwd", "http://127.0.0.1:9/a", "%2e%2e/a", "%2Fetc%2Fpasswd",
         "a%00b", "C:\\a",
         "\\\\host\\a", "a\x1b[31mb", "a\nb", "a\rb", "a\x00b", "a\x7fb", "a\u0085b", "a\u202eb", "\ufeff", "\u00e4",
         "\U0001f600", "%s%n%s%n", "{}", "{0:1000000}", "$(id)", "`id`", "'", "\"", "a.mtl", "a.obj", "a.png", "data:,",
         "data:;base64,",
         "data:application/octet-stream;base64,AAAA", "__proto__", "null", "true", "NaN", "*", "a" + "/a" * 2000, "con",
         "a.", "a "]
REPEATS = [2, 2, 3, 5, 10, 17, 100, 1000, 5000, 60000]


def few(random, most=4):
    """How many changes a mutant gets: mostly one or two."""
    return min(most, 1 + int(random.expovariate(1.1)))


def integer(random, near=0):
    """An extreme whole number, or one near the one that was there."""
    choice = random.random()
    if choice < 0.45:
        return near + random.choice([-2, -1, 1, 2])
    if choice < 0.55:
        return near * random.choice([-1, 2, 3, 256, 65536])
    value = random.choice(INTEGERS)
    return -value if random.random() < 0.25 else value


def number(random, near="0"):
    """The text of an extreme number."""
    if random.random() < 0.5:
        try:
            return str(integer(random, int(float(near))))
        except (ValueError, OverflowError):
            return str(integer(random))
    return random.choice(NUMBERS)


def name(random):
    return random.choice(NAMES)


def repeats(random, size):
    """How often something of that many bytes may be repeated without passing the budget."""
    return max(1, min(random.choice(REPEATS), BUDGET // max(1, size)))


def damage(random, data, other=b""):
    """One change of bytes that knows nothing of the format."""
    data = bytearray(data)
    if not data:
        return bytes(random.randbytes(random.choice([1, 4, 100])))
    at = random.randrange(len(data))
    length = min(random.choice([1, 1, 2, 4, 4, 8, 16, 100, 1000]), len(data) - at)
    kind = random.randrange(10)
    if kind == 0:
        data[at] ^= 1 << random.randrange(8)
    elif kind == 1:
        data[at] = random.choice([0, 1, 9, 10, 13, 32, 0x7f, 0x80, 0xfe, 0xff])
    elif kind == 2:
        del data[at:at + length]
    elif kind == 3:
        data[at:at] = data[at:at + length] * repeats(random, length)
    elif kind == 4:
        del data[at:]
    elif kind == 5:
        form = random.choice(["<H", ">H", "<I", ">I", "<f", ">f"])
        if form[1] == "f":
            patch = struct.pack(form, random.choice([float("nan"), float("inf"), -1e38, 1e-45, 3.4e38]))
        else:
            patch = struct.pack(form, random.choice(INTEGERS) & (0xffff if form[1] == "H" else 0xffffffff))
        data[at:at + len(patch)] = patch
    elif kind == 6 and other:
        start = random.randrange(len(other))
        data[at:at + length] = other[start:start + random.choice([4, 16, 100, 1000])]
    elif kind == 7:
        to = random.randrange(len(data))
        data[to:to + length] = data[at:at + length]
    elif kind == 8:
        data[at:at] = random.randbytes(length)
    else:
        data[at:at + length] = bytes([random.choice([0, 0xff, 0x20, 0x41])]) * length
    return bytes(data)
