"""Binary files as trees: numbers, bytes, and groups that write their own length or checksum around themselves."""
import struct

from mutate import damage, integer, name, repeats


class Num:
    """A number; `form` as in struct. Too large a value is cut to the field."""

    def __init__(self, form, value):
        self.form, self.value = form, value

    def bytes(self):
        if self.form[-1] in "fd":
            try:
                return struct.pack(self.form, self.value)
            except OverflowError:
                return struct.pack(self.form, float("inf"))
        size = struct.calcsize(self.form)
        order = "big" if self.form[0] == ">" else "little"
        return (int(self.value) % (1 << 8 * size)).to_bytes(size, order)


class Blob:
    """Bytes without known structure: pixels, text, compressed data."""

    def __init__(self, data):
        self.data = data

    def bytes(self):
        return self.data


class Group:
    """Items in order; `wrap` makes a chunk of their bytes, and may be told a wrong length."""

    def __init__(self, items, wrap=None):
        self.items, self.wrap, self.wrong_length = items, wrap, None

    def bytes(self):
        body = b"".join(item.bytes() for item in self.items)
        if self.wrap is None:
            return body
        return self.wrap(body, len(body) if self.wrong_length is None else self.wrong_length)


def numbers(form, *values):
    return [Num(form, value) for value in values]


def text(data, size=None):
    data = data.encode("latin-1") if isinstance(data, str) else data
    return Blob(data if size is None else data[:size].ljust(size, b"\0"))


def nodes(group, found=None):
    """Every item with the list that it stands in."""
    if found is None:
        found = []
    for k, item in enumerate(group.items):
        found.append((group.items, k))
        if isinstance(item, Group):
            nodes(item, found)
    return found


def change_item(random, item):
    """Changes one item in itself."""
    if isinstance(item, Num):
        if item.form[-1] in "fd":
            item.value = random.choice([float("nan"), float("inf"), float("-inf"), 0.0, -1.0, 1e30, -1e38, 1e-45,
                                        3.4e38])
        else:
            item.value = integer(random, int(item.value))
    elif isinstance(item, Blob):
        choice = random.random()
        if choice < 0.2:
            item.data = name(random).encode("utf-8", "surrogatepass")
        elif choice < 0.3:
            item.data = item.data[:len(item.data) // 2]
        else:
            item.data = damage(random, item.data)
    elif item.wrap is not None:
        item.wrong_length = integer(random, len(b"".join(i.bytes() for i in item.items)))


def mutate(random, tree):
    """One change of the tree: of an item, or of where items stand."""
    places = nodes(tree)
    groups = [p for p in places if isinstance(p[0][p[1]], Group)]
    plain = [p for p in places if isinstance(p[0][p[1]], Num)] or places
    if not places:
        return
    items, k = random.choice(random.choice([groups, plain, plain, places]) or places)
    choice = random.random()
    if choice < 0.6:
        change_item(random, items[k])
    elif choice < 0.7:
        del items[k]
    elif choice < 0.8:
        data = items[k].bytes()
        items.insert(k, Blob(data * repeats(random, len(data))))
    elif choice < 0.9:  # a copy elsewhere: nested, or out of order
        others = [tree] + [g[0][g[1]] for g in groups]
        target = random.choice(others).items
        target.insert(random.randrange(len(target) + 1), Blob(items[k].bytes()))
    else:
        other = random.randrange(len(items))
        items[k], items[other] = items[other], items[k]
