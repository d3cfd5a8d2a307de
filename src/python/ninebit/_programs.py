"""Combiner states, programs that run, and traces."""
import os
import warnings

import numpy as np

from . import _combiner
from ._arrays import STAGE_INPUTS, Fragments, check_out, merged, register_of, values_of
from ._combiner import Error
from ._sources import read, source_of


def _list(value):
    return [value] if isinstance(value, str) else [] if value is None else list(value)


class State(_combiner.State):
    """The combiner state of OpenGL, and its hardware profile: a name of profiles(), or the path of a .json file."""

    def __init__(self, profile="geforce2"):
        super().__init__(os.fspath(profile))

    @classmethod
    def parse(cls, text, form=None, profile=None, *, chip=None, function=None, define=None, setup=0):
        """Parses a program: a text, or the path of a file. Without `form`, finds the form of the text. The profile is
        geforce2 if none is given. A State or a Program is parsed already: the result is its state.

        The forms are those of `ninebit convert --from`. `function` is for sources, `define` for them and pixel shaders,
        `chip` for words, `setup` for logs: the number of a set-up.
        """
        if isinstance(text, (State, Program)):
            if setup or any(given is not None for given in (form, profile, chip, function, define)):
                raise TypeError("form, profile and other keywords belong to the text of a program; a State has them already")
            return text.state if isinstance(text, Program) else text
        text, file = read("text", text)
        profile = "geforce2" if profile is None else profile
        state = cls.__new__(cls)
        values = {str(name): str(value) for name, value in dict(define or {}).items()}
        try:
            _combiner.State.__init__(state, text, form, os.fspath(profile), chip, _list(function), values, setup)
        except Error as wrong:
            if file is not None:
                raise Error("\n".join(f"{file}: {line}" for line in str(wrong).splitlines())) from None
            raise
        for note in state._notes:
            warnings.warn(note, stacklevel=2)
        return state

    def __repr__(self):
        stages = self.stages
        return f"<ninebit.State of {stages} general combiner{'' if stages == 1 else 's'}, {self.profile}>"

    def _repr_html_(self):
        return None if self.validate() else Program(self)._repr_html_()

    def __hash__(self):
        return hash((self.print("json"), self._profile))

    def __reduce__(self):
        return State.parse, (self.print("json"), "json", self._profile)


class Program(_combiner.Program):
    """A compiled, valid state. It never changes, and any thread may use it.

    Takes a State, or the text or the path of a program with its form (None: found) and its profile, as State.parse().
    """

    def __init__(self, state, form=None, profile=None):
        if not isinstance(state, (State, Program)):
            source_of("state", state)  # refuses what is no program
        self.state = State.parse(state, form, profile)
        super().__init__(self.state)

    def evaluate(self, inputs=None, /, *, out=None, axis=None, registers=False, **keywords):
        """The colours of fragments, as int16 codes: `one`, mostly 255, is 1.0.

        Inputs are a dictionary, or keywords, of registers. A component, 'tex0.r', is a number or an array of any shape. A
        whole register, 'tex0', has 3 or 4 components along the last axis, such as a picture (height, width, 4), or
        along the first, such as (4, n); axis=-1 or axis=0 says which, where both would do. One number is all four
        components. All shapes broadcast. Codes are uint8 or any other integers; floats and bools are refused.

        What is not given is 0, except the alpha of textures and fog, which is 1.0, spare0.a, which is tex0.a, and the
        constants, which are the program's. Where coordinates, at0 to at3, or texels, texel0 to texel3, are given, the
        program's texture-shader stages run first and give tex0 to tex3. The result has its four components where whole registers have theirs, else
        along the first axis. `out` is an array of integers that takes it. With registers=True, a dictionary has it as
        'out', and every register after the last general combiner; of stages that ran also whether each fragment is
        'culled', and the 'depth' that replaces its own, or NaN.
        """
        fragments, fates = self._fragments(inputs, keywords, axis)
        shape = (*fragments.shape, 4) if fragments.axis == -1 else (4, *fragments.shape)
        if out is not None:
            check_out(out, shape, self.one)
        color = out if fragments.can_be_written(out) else np.empty(shape, np.int16)
        after = {name: np.empty(shape, np.int16) for name in (_combiner.REGISTERS if registers else ())}
        planes = [fragments.component_planes(array) for array in (color, *after.values())]
        self._evaluate(fragments.planes, fragments.count, planes[0], planes[1:])
        if out is not None and color is not out:
            np.copyto(out, color, casting="unsafe")  # check_out() has found that it fits
            color = out
        return {"out": color, **after, **fates} if registers else color

    def _fragments(self, inputs, keywords, axis):
        """The inputs, after the stages where coordinates or texels are given; and what these do to the fragments."""
        fragments = Fragments(merged(inputs, keywords), self.lowest, self.one, axis)
        if not fragments.given:
            return fragments, {}
        self._check_stages(fragments.given, fragments.planes)
        codes, culled, depth, notes = self._run_stages(fragments.given, fragments.count)
        for note in notes:
            warnings.warn(note, stacklevel=3)
        fragments.planes.update((f"tex{at // 4}.{'rgba'[at % 4]}", plane) for at, plane in enumerate(codes))
        return fragments, {"culled": culled.reshape(fragments.shape), "depth": depth.reshape(fragments.shape)}

    def _check_stages(self, given, codes):
        """Raises if coordinates and texels are given that no stages read, or what stages give."""
        if given and not self._has_stages:
            raise Error(f"{next(iter(given))} is for texture-shader stages, and the program has none")
        for name in codes if given else ():
            if name.startswith("tex"):
                raise Error(f"{name} is what the texture-shader stages give; expected what they read, such as texel0 and at1")

    def evaluate_real(self, inputs=None, /, *, axis=None, registers=False, **keywords):
        """The colours of fragments in real numbers, as float64: 1.0 is full intensity.

        Inputs and shapes are those of evaluate(); a code stands for code / one. Nothing is rounded, so an
        integer profile's codes can be compared with these; a profile in 32-bit floats rounds each operation to one. With
        registers=True, a dictionary has the colours as 'out', and every register after the last general combiner.
        """
        fragments, fates = self._fragments(inputs, keywords, axis)
        shape = (*fragments.shape, 4) if fragments.axis == -1 else (4, *fragments.shape)
        found = {name: np.empty(shape) for name in ("out", *(_combiner.REGISTERS if registers else ()))}
        planes = [fragments.component_planes(array) for array in found.values()]
        self._evaluate_real(fragments.planes, fragments.count, planes[0], planes[1:])
        return {**found, **fates} if registers else found["out"]

    def trace(self, registers=None, /, **keywords):
        """Every step of one fragment, as `ninebit trace --json` prints it: a dictionary that Jupyter shows as a diagram.

        Registers are given by name, 'tex0.r': 100 or 'tex0': (100, 0, 0, 255), or as keywords. Texture-shader stages that
        do more than read their textures run first, on coordinates, at1=(0.5, 0.25), and texels, texel0=(100, 0, 0,
        255), unless the registers of textures are given; the key 'texture_shader' has their values.
        """
        codes, given = {}, {}
        for name, value in merged(registers, keywords).items():
            register, component = register_of(name)
            found = values_of(name, register, value, self.lowest, self.one)
            whole = ((2,), (3,), (4,)) if register.startswith("at") else ((), (3,), (4,))
            if found.shape not in (((),) if component is not None else whole):
                kind = "number" if register.startswith("at") else "whole number"
                expected = f"one {kind}" if component is not None else f"{'2 to' if whole[0] else '3 or'} 4 {kind}s"
                raise Error(f"{name} has the shape {found.shape}; expected {expected}: a trace is of one fragment")
            letters = STAGE_INPUTS.get(register, "rgba")
            letters = letters[component] if component is not None else letters[:found.size if found.ndim else 4]
            into = given if register in STAGE_INPUTS else codes
            for letter, number in zip(letters, np.broadcast_to(found, len(letters)).tolist()):
                if f"{register}.{letter}" in into:
                    raise Error(f"{register}.{letter} is given twice; expected a whole register or its components, not both")
                into[f"{register}.{letter}"] = number
        self._check_stages(given, codes)
        trace = Trace({"profile": self.profile, **self._trace(codes, given)})
        trace._state, trace._codes = self.state, {**codes, **given}
        return trace

    def __repr__(self):
        stages = self.stages
        return f"<ninebit.Program of {stages} general combiner{'' if stages == 1 else 's'}, {self.profile}>"

    def _repr_html_(self):
        from ._calls import page_of  # loads many libraries
        from ._results import framed
        return framed(page_of(("explain",), self.state))

    def __reduce__(self):
        return Program, (self.state,)


class Trace(dict):
    """Every value at every step of one fragment, with the keys of `ninebit trace --json`; Jupyter shows a diagram."""

    _state = _codes = _page = None  # what was traced, or its page

    def __repr__(self):
        stages, out = len(self.get("stages", ())), self.get("out") or {}
        colour = ", ".join(str(code) for code in out.get("codes", ()))
        return f"<ninebit.Trace of {stages} stage{'' if stages == 1 else 's'}, {self.get('profile', '?')}: out {colour or 'none'}>"

    def _repr_html_(self):
        if self._page is None and self._state is not None:
            from ._calls import page_of  # loads many libraries
            self._page = page_of(("trace",), self._state, set=self._codes)
        from ._results import framed
        return framed(self._page)
