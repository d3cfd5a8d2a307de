"""What the verbs return: dictionaries with the keys of --json, with pictures as arrays and rows as structured arrays."""
import html
import uuid

import numpy as np


# In a notebook's frame, pictures and answers come first and how they were made last; the page says how high it is.
_IN_A_FRAME = """<style>main { display: flex; flex-direction: column } main > header, main > .made { order: 1 }</style>
<script>{
  const made = document.querySelector("header > .made");
  if (made) document.querySelector("main").append(made);
  const say = () => parent.postMessage({ ninebitHeight: Math.ceil(document.documentElement.getBoundingClientRect().height) + 2 }, "*");
  new ResizeObserver(say).observe(document.body);
}</script>
"""

# For the notebook's page: a frame takes the height of its page, where the notebook runs scripts, until it is removed.
_BESIDE_A_FRAME = """<script>{
  const frame = document.getElementById("NAME");
  const hear = (event) => {
    if (!frame?.isConnected) return removeEventListener("message", hear);
    const height = event.source === frame.contentWindow ? Number(event.data?.ninebitHeight) : 0;
    if (height > 0) frame.style.height = `${Math.min(height, 20000)}px`;
  };
  addEventListener("message", hear);
}</script>"""


def framed(page, height=560):
    """A page as an element of another one: a frame that holds it whole, and loads nothing. Pages save their plots as
    downloads. `height`, in pixels, is for notebooks that run no scripts."""
    if page is None:
        return None
    body, end, rest = page.rpartition("</body>")
    page = body + _IN_A_FRAME + end + rest if end else page
    name = f"ninebit-{uuid.uuid4().hex}"  # a notebook may hold many
    return (f'<iframe id="{name}" sandbox="allow-scripts allow-downloads" '
            f'style="width:100%;height:{height}px;border:1px solid #ccc" srcdoc="{html.escape(page)}"></iframe>'
            + _BESIDE_A_FRAME.replace("NAME", name))


def _cells(row, prefix=""):
    """The row's values by name; those of inner dictionaries as 'pixels.lit'."""
    for name, value in row.items():
        if isinstance(value, dict):
            yield from _cells(value, f"{prefix}{name}.")
        else:
            yield prefix + name, value


def _column(values):
    """The values with one type: text, whole numbers, or real numbers, where NaN is missing."""
    given = [value for value in values if value is not None]
    if any(not isinstance(value, (bool, int, float, str)) for value in given):
        return values, object
    if any(isinstance(value, str) for value in given):
        return ["" if value is None else str(value) for value in values], f"U{max(1, *(len(str(v)) for v in given))}"
    if len(given) < len(values) or any(isinstance(value, float) for value in given):
        return [np.nan if value is None else value for value in values], "f8"
    if all(isinstance(value, bool) for value in given):
        return values, "?"
    return values, "i8" if all(-2**63 <= value < 2**63 for value in given) else "u8"


def structured(rows):
    """Rows as a structured array with one field a column."""
    flat = [dict(_cells(row)) for row in rows]
    names = list(dict.fromkeys(name for row in flat for name in row))
    columns = [_column([row.get(name) for row in flat]) for name in names]
    table = np.empty(len(flat), dtype=[(name, kind) for name, (_, kind) in zip(names, columns)])
    for name, (values, _) in zip(names, columns):
        table[name] = values
    return table


class _Answer(dict):
    """A verb's answer, with what it gave besides."""

    _page = None

    @classmethod
    def _of(cls, answer, texts, arrays):
        made = cls(answer)
        made._page = texts.get("page")
        made._take(texts, arrays)
        return made

    def _take(self, texts, arrays):
        pass

    def _repr_html_(self):
        return framed(self._page)

    def __repr__(self):
        return f"<ninebit.{type(self).__name__}: {self._words()}>"


_FACES = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"]


def _layers(arrays):
    """The arrays PART.CHANNEL by part: channels as (height, width, channels), faces of a cube as (6, size, size)."""
    parts = {}
    for name, array in arrays:
        part, _, channel = name.rpartition(".")
        parts.setdefault(part, {})[channel] = array
    layers = {}
    for part, channels in parts.items():
        planes = list(channels.values())
        if any(plane.shape != planes[0].shape or plane.dtype != planes[0].dtype for plane in planes):
            layers.update({f"{part}.{channel}": plane for channel, plane in channels.items()})
        elif list(channels) == _FACES:
            layers[part] = np.stack(planes)
        else:
            layers[part] = planes[0] if len(planes) == 1 else np.stack(planes, axis=-1)
    return layers


class _Picture(_Answer):
    """A picture: `color` (height, width, 4), `depth` and `stencil` (height, width), `pictures` by name, and `layers`,
    by name: the maps of the light and, with layers=True, every intermediate value.

    Without a stencil buffer, `stencil` is empty. `frames` has the pictures of a turntable, else it is None.
    """

    def _take(self, texts, arrays):
        frames = [array for name, array in arrays if name == "frames"]
        pictures = {name: array for name, array in arrays if "." not in name and name != "frames"}
        self.color = pictures.pop("color")
        self.depth = pictures.pop("depth")
        self.stencil = pictures.pop("stencil", np.empty((0, 0), np.uint8))
        self.frames = np.stack(frames) if frames else None
        self.pictures = pictures
        self.layers = _layers((name, array) for name, array in arrays if "." in name)

    def _repr_html_(self):
        return None

    def _repr_png_(self):
        from ._verbs import png
        return png(np.ascontiguousarray(self.color[..., :3]))

    def _words(self):
        height, width = self.color.shape[:2]
        return f"{width} x {height} pixels, {self['profile']}"


class Rendering(_Picture):
    """A rendered scene: the answer of `ninebit render --json`, with its pictures as arrays."""

    def _words(self):
        pixels = self["pixels"]
        return (f"{super()._words()}, {self['technique']}: {pixels['lit']} lit, {pixels['shadowed']} shadowed, "
                f"{pixels['background']} background")


class Drawing(_Picture):
    """A drawn program or effect: the answer of `ninebit draw --json`, with its pictures as arrays."""

    def _words(self):
        return f"{super()._words()}, {len(self['passes'])} pass{'' if len(self['passes']) == 1 else 'es'}"


class Comparison(_Answer):
    """Renderings side by side: the answer of `ninebit compare --json`. `rows` is a structured array, `pictures` has the
    pictures (height, width, 3) by the rows' names, `wrong` the wrong pixels (height, width): 0, or the number of the
    cause, plus 128 if the pixel is falsely lit. `sheet` is the picture of the option `sheet`, or None."""

    def _take(self, texts, arrays):
        self.rows = structured(self["rows"])
        self.pictures = {name[len("color "):]: array for name, array in arrays if name.startswith("color ")}
        self.wrong = {name[len("wrong "):]: array for name, array in arrays if name.startswith("wrong ")}
        self.sheet = next((array for name, array in arrays if name == "sheet"), None)

    def _words(self):
        return f"{len(self.rows)} renderings of {self['scene']}, {self['profile']}"


class Report(_Answer):
    """A study: the answer of `ninebit study --json`. `rows` is a structured array, `tables` has it and the others."""

    def _take(self, texts, arrays):
        self.tables = {name: structured(value) for name, value in self.items()
                       if isinstance(value, list) and all(isinstance(row, dict) for row in value)}
        self.rows = self.tables.get("rows")

    def _words(self):
        tables = ", ".join(f"{name} {len(table)}" for name, table in self.tables.items())
        return f"{self.get('question', self.get('command'))}: {tables}"


class Proof(_Answer):
    """An answer of `ninebit prove --json`. It is true if the question is proved."""

    def __bool__(self):
        return self.get("answer") == "proved"

    def _words(self):
        return f"{self.get('question')} {self.get('answer', '')}".strip() + (
            f" after {self['cases']} cases" if "cases" in self else "")

    def _repr_html_(self):
        return None


class Explanation(_Answer):
    """What a program computes: the answer of `ninebit explain --json`; str() is its text."""

    def _take(self, texts, arrays):
        self.text = texts.get("text", "")

    def __str__(self):
        return self.text

    def _words(self):
        return f"{len(self.text.splitlines())} lines, {self.get('profile')}"


class Vectors(_Answer):
    """A pack of `ninebit vectors`: `text` is vectors.txt, `programs` has its programs as JSON texts, one a program."""

    def _take(self, texts, arrays):
        self.text = texts.get("vectors", "")
        self.programs = texts.get("programs", "").splitlines()
        self.rows = structured(self["rows"])

    def _words(self):
        return f"{self['programs']} programs of {self['fragments']} fragments, {self['profile']}, seed {self['seed']}"

    def _repr_html_(self):
        return None
