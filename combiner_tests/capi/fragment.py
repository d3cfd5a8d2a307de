"""The C interface from Python by ctypes, without a compiler: the steps of fragment.c.

usage: fragment.py [PATH OF libninebit_capi.so]
"""
import ctypes
import json
import sys
from ctypes import POINTER, byref, c_char_p, c_int, c_int16, c_size_t, c_uint8, c_void_p, sizeof

OK, RC10, PRIMARY, TEXTURE0 = 0, 1, 4, 8


class Registers(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("code", c_int16 * 4 * 12)]


class Inputs(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("primary", c_uint8 * 4),
        ("secondary", c_uint8 * 4),
        ("fog_color", c_uint8 * 3),
        ("fog_factor", c_uint8),
        ("fog_enabled", c_uint8),
        ("texture_enabled", c_uint8 * 4),
        ("texture", c_uint8 * 4 * 4),
    ]


class Planes(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("count", c_size_t),
        ("input", POINTER(c_int16) * 4 * 12),
        ("color", POINTER(c_int16) * 4),
    ]


library = ctypes.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libninebit_capi.so")
library.ninebit_version.restype = c_char_p
# A text that the caller frees keeps its address: so not c_char_p, which Python would turn into bytes.
library.ninebit_free_text.argtypes = [c_void_p]
library.ninebit_program_free.argtypes = library.ninebit_state_free.argtypes = [c_void_p]


class Refused(Exception):
    pass


def take(text):
    """The Python string of a text of the library, which is freed."""
    answer = ctypes.string_at(text).decode() if text else ""
    library.ninebit_free_text(text)
    return answer


def call(name, *arguments):
    """Calls a function whose last parameter is the error; raises Refused with its text."""
    error = c_void_p()
    if getattr(library, name)(*arguments, byref(error)) != OK:
        raise Refused(take(error))


def compiled(text):
    state, program, source = c_void_p(), c_void_p(), text.encode()
    call("ninebit_state_parse", b"geforce2", RC10, source, c_size_t(len(source)), byref(state))
    try:
        call("ninebit_compile", state, byref(program))
    finally:
        library.ninebit_state_free(state)
    return program


program = compiled(
    """!!RC1.0
{
  rgb { spare0 = col0 * tex0; scale_by_two(); }
}
out.rgb = spare0;
out.a = unsigned_invert(zero);
"""
)
try:
    compiled("!!RC1.0\nout.rgb = spare2;")
except Refused as refusal:
    print("refused:", refusal)

inputs = Inputs(struct_size=sizeof(Inputs), primary=(201, 99, 51, 255))
inputs.texture_enabled[0] = 1
inputs.texture[0][:] = (128, 128, 128, 255)
registers = Registers(struct_size=sizeof(Registers))
call("ninebit_initial_registers", program, byref(inputs), byref(registers))
color = (c_int16 * 4)()
call("ninebit_evaluate", program, byref(registers), color, None)
print("one fragment:", *color)

count = 1000
primary = (c_int16 * count)(*(i % 256 for i in range(count)))
texel = (c_int16 * count)(*[128] * count)
red = (c_int16 * count)()
planes = Planes(struct_size=sizeof(Planes), count=count)
planes.input[PRIMARY][0] = primary
planes.input[TEXTURE0][0] = texel
planes.color[0] = red
call("ninebit_evaluate_planes", program, byref(planes))
print("red of fragment 201:", red[201])

text = c_void_p()
call("ninebit_trace_json", program, byref(registers), byref(text))
print("the trace tells of codes:", "yes" if json.loads(take(text))["out"]["codes"] == list(color) else "no")
call("ninebit_emit_glsl", program, c_int(330), b"combine", byref(text))
print("GLSL begins with", take(text)[:12])
library.ninebit_program_free(program)
