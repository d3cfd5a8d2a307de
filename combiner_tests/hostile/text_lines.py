"""Texts of lines and words: OBJ, MTL, OFF, the header of PLY, the languages of programs, tables."""
import re

from mutate import BUDGET, integer, name, number, repeats

NUMBER = re.compile(r"[-+]?[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?$")


def change_word(random, words, k, keywords, everything):
    """Replaces one word by a number, a name, a keyword or a word from elsewhere."""
    choice = random.random()
    if choice < 0.45 and NUMBER.match(words[k]):
        words[k] = number(random, words[k])
    elif choice < 0.6 and "/" in words[k]:  # OBJ's v/vt/vn
        pieces = words[k].split("/")
        pieces[random.randrange(len(pieces))] = str(integer(random, 1))
        words[k] = "/".join(pieces) + random.choice(["", "", "/", "/1"])
    elif choice < 0.7:
        words[k] = name(random)
    elif choice < 0.85 and keywords:
        words[k] = random.choice(keywords)
    else:
        line = random.choice(everything)
        words[k] = random.choice(line) if line else str(integer(random))


def change_line(random, lines, at, keywords):
    """Changes within one line."""
    words = lines[at]
    kind = random.randrange(6)
    if kind <= 2 and words:
        change_word(random, words, random.randrange(len(words)), keywords, lines)
    elif kind == 3 and words:
        del words[random.randrange(len(words))]
    elif kind == 4 and words:
        k = random.randrange(len(words))
        words[k:k] = [words[k]] * repeats(random, len(words[k]) + 1)
    else:
        words.insert(random.randrange(len(words) + 1), random.choice([name(random), number(random), "#", "\\", "\""]))


def change_lines(random, lines, at, keywords):
    """Changes of whole lines."""
    kind = random.randrange(8)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        size = sum(map(len, lines[at])) + len(lines[at])
        lines[at:at] = [list(lines[at]) for _ in range(repeats(random, size))]
    elif kind == 2:
        lines.insert(random.randrange(len(lines) + 1), lines.pop(at))
    elif kind == 3:
        del lines[at:]
    elif kind == 4 and keywords:
        lines.insert(at, [random.choice(keywords)] + [random.choice([number(random), name(random)])
                                                      for _ in range(random.randrange(4))])
    elif kind == 5 and at + 1 < len(lines):
        lines[at] += lines.pop(at + 1)
    elif kind == 6:
        lines[at] = lines[at] + ["\\"]
    else:
        end = min(len(lines), at + random.choice([1, 2, 5, 20]))
        block = lines[at:end]
        size = sum(len(word) + 1 for line in block for word in line)
        lines[at:at] = [list(line) for _ in range(repeats(random, size)) for line in block]


def finish(random, text):
    """Sometimes the whole text changes: its line ends, its encoding, its order of magnitude."""
    choice = random.random()
    if choice < 0.90:
        return text.encode("utf-8", "surrogateescape")
    if choice < 0.95:
        ends = random.choice(["\r\n", "\r", "\n\r", "\n\n", "\f\n", "\v\n", " \n", "\0\n", "\t\n", ""])
        return text.replace("\n", ends).encode("utf-8", "surrogateescape")
    if choice < 0.97:
        return text.encode(random.choice(["utf-16", "utf-16-be", "utf-8-sig", "utf-32"]), "replace")
    return (text * max(1, min(50, BUDGET // max(1, len(text))))).encode("utf-8", "surrogateescape")


def mutate(random, data, keywords, changes, comma=False):
    """So many changes of a text."""
    text = data.decode("utf-8", "surrogateescape")
    separator = "," if comma else None
    lines = [line.split(separator) for line in text.split("\n")]
    for _ in range(changes):
        if not lines:
            break
        at = random.randrange(len(lines))
        if random.random() < 0.6:
            change_line(random, lines, at, keywords)
        else:
            change_lines(random, lines, at, keywords)
    joined = "\n".join(("," if comma else " ").join(line) for line in lines)
    return finish(random, joined) if changes else data
