"""Register codes in the shapes of NumPy: what Program.evaluate takes and returns."""
import numpy as np

from ._combiner import REGISTERS, Error, nearest_name, register_named

_LETTERS = "rgba"
# What texture-shader stages read of a fragment: coordinates and bytes of texels.
STAGE_INPUTS = {**{f"at{unit}": "strq" for unit in range(4)}, **{f"texel{unit}": "rgba" for unit in range(4)}}
_COMPONENTS = [f"{register}.{letter}" for register in REGISTERS for letter in _LETTERS]


def register_of(name, keyword=False):
    """The register and the component, or None, of 'tex0' or 'tex0.r', and of the languages' names, such as 't0.r'."""
    if not isinstance(name, str):
        raise TypeError(f"a register's name must be str, such as 'tex0' or 'tex0.r', not {type(name).__name__}")
    register, dot, letter = name.partition(".")
    known = register if register in STAGE_INPUTS else register_named(register)
    letters = STAGE_INPUTS.get(register, _LETTERS)
    if known and (not dot or (len(letter) == 1 and letter in letters)):
        return known, letters.index(letter) if dot else None
    known = [*REGISTERS, *(["out", "axis", "registers"] if keyword else _COMPONENTS)]
    raise (TypeError if keyword else Error)(
        f"'{name}' is not a register{' or an option' if keyword else ''}; expected one of {', '.join(REGISTERS)}"
        + (", out, axis, registers" if keyword else ", alone or with .r, .g, .b or .a") + nearest_name(name, known))


def merged(inputs, keywords):
    """The inputs of a dictionary and of keyword arguments as one dictionary."""
    if inputs is None:
        inputs = {}
    if not hasattr(inputs, "items"):
        raise TypeError(f"inputs must be a dictionary of registers, such as {{'tex0.r': codes}}, not {type(inputs).__name__}")
    for name in keywords:
        register_of(name, keyword=True)
        if name in inputs:
            raise TypeError(f"'{name}' is given twice: in the dictionary and as a keyword")
    return {**inputs, **keywords}


def codes_of(name, value, lowest, one):
    """The value as an array of uint8 or int16; TypeError for other types than whole numbers, Error for other codes."""
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array; expected one without a mask, such as {name}.filled(0)")
    try:
        array = np.asarray(value)
    except ValueError as wrong:
        raise Error(f"{name} is not an array: {wrong}") from None
    if array.size == 0 and not isinstance(value, np.ndarray):
        array = array.astype(np.int16)
    if array.dtype.kind not in "iu":
        found = f"an array of {array.dtype}" if isinstance(value, np.ndarray) else type(value).__name__
        if array.dtype.kind not in "bf" and not isinstance(value, np.ndarray):
            raise TypeError(f"{name} is {found}; expected whole numbers from {lowest} to {one}, in an array, a list or alone")
        if not isinstance(value, np.ndarray):
            found += f" of {array.dtype}" if array.ndim else ""
        raise TypeError(f"{name} is {found}; expected codes, which are whole numbers from {lowest} to {one}, where {one} "
                        f"is 1.0; numpy.rint({one} * x).astype(int) makes them of real numbers x")
    if array.dtype not in (np.dtype(np.uint8), np.dtype(np.int16)) or not array.flags.aligned:
        for code in (array.min(), array.max()) if array.size else ():
            if not lowest <= int(code) <= one:
                raise Error(f"{name} has the code {code}; expected {lowest} to {one}")
        array = array.astype(np.int16)
    return array


def coordinates_of(name, value):
    """The value as an array of float32; TypeError for other types than numbers."""
    array = np.asarray(value)
    if isinstance(value, np.ma.MaskedArray) or array.dtype.kind not in "iuf":
        found = f"an array of {array.dtype}" if isinstance(value, np.ndarray) else type(value).__name__
        raise TypeError(f"{name} is {found}; expected numbers, in an array without a mask, a list or alone")
    return array.astype(np.float32)


def values_of(name, register, value, lowest, one):
    """The value of a register as codes, of coordinates as float32, of texels as uint8."""
    if register not in STAGE_INPUTS:
        return codes_of(name, value, lowest, one)
    if register.startswith("at"):
        return coordinates_of(name, value)
    codes = codes_of(name, value, 0, 255)
    if codes.size and (codes.min() < 0 or codes.max() > 255):
        raise Error(f"{name} has the byte {codes.min() if codes.min() < 0 else codes.max()}; expected 0 to 255")
    return codes.astype(np.uint8, copy=False)


def _component_axis(name, shape, axis):
    """Where a whole register has its components: 0 or -1. `axis` is where it has to have them, or None."""
    found = [a for a in (0, -1) if shape[a] in (3, 4)]
    if axis in found:
        return axis
    if len(found) == 2:
        raise Error(f"{name} has the shape {shape}, with 3 or 4 elements along the first and the last axis; expected axis=0 "
                    "or axis=-1, which says where the components are")
    if axis is not None or not found:
        where = "the first or the last axis" if axis is None else f"axis {axis}, as axis or another register says"
        raise Error(f"{name} has the shape {shape}; expected 3 or 4 components along {where}")
    return found[0]


class Fragments:
    """The planes of all inputs, of one shape: `planes` of registers, `given` of coordinates and texels."""

    def __init__(self, inputs, lowest, one, axis):
        if axis not in (None, 0, -1) or isinstance(axis, bool):
            raise Error(f"axis is {axis!r}; expected 0 or -1, the axis of a register's components")
        if not inputs:
            raise Error("there are no inputs; expected at least one register, which gives the shape")
        self.axis = axis
        planes = {}
        for name, value in inputs.items():
            register, component = register_of(name)
            codes = values_of(name, register, value, lowest, one)
            if component is not None:
                self._add(planes, register, component, name, codes)
                continue
            for c, plane in enumerate(self._split(name, register, codes)):
                self._add(planes, register, c, name, plane)
        try:
            self.shape = np.broadcast_shapes(*(plane.shape for plane in planes.values()))
        except ValueError:
            shapes = ", ".join(f"{name} {plane.shape}" for name, plane in planes.items())
            raise Error(f"the shapes of the inputs do not broadcast together: {shapes}") from None
        self.count = int(np.prod(self.shape, dtype=np.int64))
        flat = {name: self._flat(plane) for name, plane in planes.items()}
        self.given = {name: plane for name, plane in flat.items() if name.partition(".")[0] in STAGE_INPUTS}
        self.planes = {name: plane for name, plane in flat.items() if name not in self.given}

    def _split(self, name, register, codes):
        """A whole register's components."""
        coordinates = register.startswith("at")
        if codes.ndim == 0 and not coordinates:
            return [codes] * 4
        if codes.ndim < 2 and coordinates:
            if codes.ndim == 0 or len(codes) not in (2, 3, 4):
                raise Error(f"{name} has the shape {codes.shape}; expected two to four coordinates s, t, r, q, or an array of "
                            f"three or four; one coordinate of n fragments is '{name}.s'")
            return list(codes)
        if codes.ndim == 1:
            if len(codes) not in (3, 4):
                raise Error(f"{name} has the shape {codes.shape}; expected one colour of 3 or 4 components, or an array of "
                            f"them; one component of n fragments is '{name}.r'")
            return list(codes)
        self.axis = _component_axis(name, codes.shape, self.axis)
        return list(np.moveaxis(codes, self.axis, 0))

    def _add(self, planes, register, component, name, plane):
        key = f"{register}.{STAGE_INPUTS.get(register, _LETTERS)[component]}"
        if key in planes:
            raise Error(f"{key} is given twice; expected a whole register or its components, not both ({name})")
        planes[key] = plane

    def _flat(self, plane):
        if plane.size == 1:
            return plane.reshape(1)
        return (plane if plane.shape == self.shape else np.broadcast_to(plane, self.shape)).reshape(-1)

    def component_planes(self, array):
        """A view of a contiguous array of results, of the shape (4, count)."""
        return array.reshape(self.count, 4).T if self.axis == -1 else array.reshape(4, self.count)

    def can_be_written(self, out):
        """Whether results can go into `out` one by one while inputs are read."""
        if out is None or out.dtype not in (np.dtype(np.uint8), np.dtype(np.int16)) or not out.flags.c_contiguous:
            return False
        return out.flags.aligned and not any(np.may_share_memory(out, plane) for plane in self.planes.values())


def check_out(out, shape, one):
    """Raises unless an array can take the colours."""
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out is {type(out).__name__}; expected an array of whole numbers with the shape {shape}")
    if out.dtype.kind not in "iu" or np.iinfo(out.dtype).max < one:
        raise TypeError(f"out is an array of {out.dtype}; expected whole numbers that hold codes from 0 to {one}")
    if out.shape != shape:
        raise Error(f"out has the shape {out.shape}; expected {shape}")
    if not out.flags.writeable:
        raise Error("out is read-only; expected an array that can be written")
