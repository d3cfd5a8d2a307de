"""JSON as a tree that can hold what the standard forbids: keys twice, numbers of any text, half a value."""
import json

from mutate import integer, name, number, repeats


class Number:
    """A number by its text."""

    def __init__(self, text):
        self.text = text


class Raw:
    """Text that goes into the file as it is."""

    def __init__(self, text):
        self.text = text


class Object:
    """Pairs of a key and a value, in order; a key may occur twice."""

    def __init__(self, pairs):
        self.pairs = [list(pair) for pair in pairs]

    def get(self, key):
        return next((value for k, value in self.pairs if k == key), None)

    def set(self, key, value):
        for pair in self.pairs:
            if pair[0] == key:
                pair[1] = value
                return
        self.pairs.append([key, value])


def parse(text):
    return json.loads(text, object_pairs_hook=Object, parse_int=Number, parse_float=Number, parse_constant=Number)


def write(node):
    if isinstance(node, Object):
        return "{" + ",".join(json.dumps(k) + ":" + write(v) for k, v in node.pairs) + "}"
    if isinstance(node, list):
        return "[" + ",".join(map(write, node)) + "]"
    if isinstance(node, (Number, Raw)):
        return node.text
    return json.dumps(node)


def encode(node):
    return write(node).encode("utf-8", "surrogatepass")


def slots(node, pattern="", found=None):
    """Every place of a value as (pattern, container, key): elements of one array share a pattern."""
    if found is None:
        found = {}
    if isinstance(node, Object):
        for pair in node.pairs:
            place = f"{pattern}.{pair[0][:40]}"
            found.setdefault(place, []).append((pair, 1))
            slots(pair[1], place, found)
    elif isinstance(node, list):
        place = pattern + "[]"
        for k, value in enumerate(node):
            found.setdefault(place, []).append((node, k))
            slots(value, place, found)
    return found


def pick(random, tree):
    """A place: first its kind, then one of that kind, so that a long array does not hide a rare count."""
    found = slots(tree)
    if not found:
        return None
    container, key = random.choice(found[random.choice(sorted(found))])
    return container, key


def containers(node, found=None):
    if found is None:
        found = []
    if isinstance(node, Object):
        found.append(node)
        for _, value in node.pairs:
            containers(value, found)
    elif isinstance(node, list):
        found.append(node)
        for value in node:
            containers(value, found)
    return found


def other_value(random, old):
    """A value in place of another: near it, extreme, or of another kind."""
    if isinstance(old, Number) and random.random() < 0.75:
        text = number(random, old.text)
        valid = text.lstrip("-").replace(".", "", 1).isdigit()
        return Number(text) if valid or random.random() < 0.4 else Number(str(integer(random)))
    if isinstance(old, str) and random.random() < 0.75:
        return name(random)
    if isinstance(old, bool) and random.random() < 0.5:
        return not old
    if random.random() < 0.1:
        return random.choice([Raw("[" * 70 + "]" * 70), Raw("[" * 3000 + "]" * 3000),
                              Raw("{\"a\":" * 200 + "0" + "}" * 200)])
    return random.choice([None, True, False, "", [], Object([]), Number("0"), Number("-1"), Number("1.5"), "1", [[]],
                          [None]])


def change_structure(random, tree, holder, key):
    """Removes, repeats, moves or nests what stands in a place."""
    node = random.choice(containers(tree))
    items = node.pairs if isinstance(node, Object) else node
    kind = random.choice([0, 0, 0, 1, 1, 2, 2, 3, 4, 5, 5, 5, 6, 7])
    if kind == 0 and items:
        del items[random.randrange(len(items))]
    elif kind == 1 and items:
        k = random.randrange(len(items))
        text = write(items[k][1] if isinstance(node, Object) else items[k])
        times = range(repeats(random, len(text)))
        items[k:k] = [[items[k][0], Raw(text)] if isinstance(node, Object) else Raw(text) for _ in times]
    elif kind == 2 and len(items) > 1:
        random.shuffle(items)
    elif kind == 3 and isinstance(node, Object):
        node.pairs.append([random.choice(node.pairs)[0] if node.pairs else "a", other_value(random, None)])
    elif kind == 4 and isinstance(node, Object) and node.pairs:
        random.choice(node.pairs)[0] = name(random)
    elif kind == 5:
        from_holder, from_key = pick(random, tree)
        holder[key] = Raw(write(from_holder[from_key]))
    elif kind == 6:
        depth = random.choice([1, 2, 20, 63, 64, 65, 500, 20000])
        holder[key] = Raw("[" * depth + write(holder[key]) + "]" * depth)
    elif items:
        del items[random.randrange(len(items)):]


def mutate(random, tree):
    """One change of the tree."""
    found = slots(tree)
    if not found:
        return
    pattern = random.choice(sorted(found))
    holder, key = random.choice(found[pattern])
    choice = random.random()
    if choice < 0.4:
        holder[key] = other_value(random, holder[key])
    elif choice < 0.65:  # a reference to something else: of the same place in another element, or of the same kind
        values = [h[k] for h, k in found[pattern]]
        if random.random() < 0.5:
            values = [h[k] for places in found.values() for h, k in places if type(h[k]) is type(holder[key])]
        holder[key] = Raw(write(random.choice(values)))
    else:
        change_structure(random, tree, holder, key)
