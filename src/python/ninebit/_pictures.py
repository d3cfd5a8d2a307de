"""The verbs that draw, as functions."""
from ._calls import run_verb
from ._programs import Trace
from ._results import Comparison, Drawing, Rendering


def render(scene, *, progress=None, **options):
    """Renders a scene with shadows, as `ninebit render`; returns a Rendering. options("render") lists the options.

    Without `output`, nothing is written. `progress` is called with the share that is done, 0 to 1, and a word.
    """
    return Rendering._of(*run_verb(("render",), [("scene", scene, False)], options, progress))


def draw(program, *, progress=None, **options):
    """Draws a program on textures and a mesh, or an effect file, as `ninebit draw`; returns a Drawing.

    Textures are files, built-in names, or pictures as arrays of uint8. options("draw") lists the options.
    """
    return Drawing._of(*run_verb(("draw",), [("program", program, True)], options, progress))


def compare(scene, *, progress=None, **options):
    """Renders a scene by several techniques, or with several settings, as `ninebit compare`; returns a Comparison.

    `vary` has lists of values by option: vary={"index_step": [1, 2, 3]}. options("compare") lists the options.
    """
    return Comparison._of(*run_verb(("compare",), [("scene", scene, False)], options, progress))


def trace(program=None, *, progress=None, **options):
    """Traces one fragment, as `ninebit trace`: of registers that are given by `set`, or of the `pixel` of a `scene` or of
    an `effect`; returns a Trace. options("trace") lists the options. Program.trace() does the first without files."""
    positional = [] if program is None else [("program", program, True)]
    answer, texts, _ = run_verb(("trace",), positional, options, progress)
    found = Trace(answer)
    found._page = texts.get("page")
    return found
