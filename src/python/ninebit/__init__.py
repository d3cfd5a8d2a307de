"""GeForce 2 register combiners to the bit, and the shadow techniques built on them."""
from ._combiner import Error, __version__, profiles, simd_target
from ._programs import Program, State, Trace

# Loaded by the first call: drawing, studies and proofs need many libraries, programs need none.
_LATER = {
    "render": "_pictures", "draw": "_pictures", "compare": "_pictures", "trace": "_pictures",
    "study": "_questions", "prove": "_questions", "explain": "_questions", "convert": "_questions",
    "vectors": "_questions", "options": "_calls",
    "Rendering": "_results", "Drawing": "_results", "Comparison": "_results", "Report": "_results",
    "Proof": "_results", "Explanation": "_results", "Vectors": "_results",
}

__all__ = ["Error", "Program", "State", "Trace", "__version__", "profiles", "simd_target", *_LATER]


def __getattr__(name):
    if name not in _LATER:
        from ._combiner import nearest_name
        raise AttributeError(f"module 'ninebit' has no attribute '{name}'{nearest_name(name, __all__)}")
    import importlib
    value = getattr(importlib.import_module(f".{_LATER[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__():
    return __all__
