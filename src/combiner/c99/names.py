"""Names and types of the C99 files, and how their comments are written: for generate.py."""
import re
import sys
import textwrap
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
COMBINER = 'include/ninebit/combiner/'
NUMERICS = 'include/ninebit/numerics/'
PROFILE = NUMERICS + 'hardware_profile.h'
LAYOUT = 'src/language/register_words/register_words_layout.h'

# Enumerations: file, name in C, prefix of their constants.
ENUMS = {
    'Register': (COMBINER + 'registers.h', 'nbc_register', 'NBC_'),
    'InputMapping': (COMBINER + 'registers.h', 'nbc_mapping', 'NBC_'),
    'ComponentUsage': (COMBINER + 'registers.h', 'nbc_usage', 'NBC_USE_'),
    'Scale': (COMBINER + 'registers.h', 'nbc_scale', 'NBC_SCALE_'),
    'Bias': (COMBINER + 'registers.h', 'nbc_bias', 'NBC_BIAS_'),
    'PortionName': (COMBINER + 'registers.h', 'nbc_portion_name', 'NBC_PORTION_'),
    'Variable': (COMBINER + 'registers.h', 'nbc_variable', 'NBC_VARIABLE_'),
    'Narrowing': (PROFILE, 'nbc_narrowing', 'NBC_NARROW_'),
    'NarrowingPoint': (PROFILE, 'nbc_narrowing_point', 'NBC_NARROW_'),
    'StateParameter': (COMBINER + 'validate.h', 'nbc_parameter', 'NBC_PARAMETER_'),
    'GlError': (COMBINER + 'validate.h', 'nbc_gl_error', 'NBC_GL_'),
    'StateFault': ('src/combiner/state_rules.h', 'nbc_fault_kind', 'NBC_FAULT_'),
}
# Structs: file, name in C, members that C does not have.
STRUCTS = {
    'CombinerInput': (COMBINER + 'state.h', 'nbc_input', ()),
    'PortionOutput': (COMBINER + 'state.h', 'nbc_output', ()),
    'Portion': (COMBINER + 'state.h', 'nbc_portion', ()),
    'GeneralCombiner': (COMBINER + 'state.h', 'nbc_general', ()),
    'FinalCombiner': (COMBINER + 'state.h', 'nbc_final', ()),
    'CombinerState': (COMBINER + 'state.h', 'nbc_state', ('origin',)),
    'ProgramStage': (COMBINER + 'program.h', 'nbc_stage', ('unset',)),
    'Program': (COMBINER + 'program.h', 'nbc_program', ('unset',)),
}

# Other types: in C, and whether they are arrays of so many.
TYPES = {
    'HardwareProfile': 'nbc_profile', 'Datapath': 'nbc_profile', 'Target': 'nbc_target', 'V': 'int',
    'Findings': 'nbc_findings', 'ChannelSteps<Domain>': 'nbc_channel', 'FinalSteps<Domain>': 'nbc_final_steps',
    'std::uint8_t': 'uint8_t', 'std::uint32_t': 'uint32_t', 'std::size_t': 'int', 's9': 'int16_t', 'bool': 'bool',
    'int': 'int', 'float': 'float', 'double': 'double', 'void': 'void', 'CodeDomain': 'nbc_codes',
    'FinalCodes': 'nbc_final_codes',
}
ARRAYS = {
    'Rgba9': ('int16_t', '[4]'), 'ColorF': ('float', '[4]'), 'RegisterFile': ('int16_t', '[NBC_REGISTERS][4]'),
    'StageSteps<Domain>': ('nbc_channel', '[4]'), 'std::array<bool, 4>': ('bool', '[4]'),
}
BY_VALUE = {'Target'}  # structs that functions get as they are
CONSTANTS = {
    'kMaxGeneralCombiners': 'NBC_MAX_GENERAL_COMBINERS', 'kRegisterCount': 'NBC_REGISTERS', 'kRed': 'NBC_RED',
    'kGreen': 'NBC_GREEN', 'kBlue': 'NBC_BLUE', 'kAlpha': 'NBC_ALPHA', 'kReserved': 'NBC_DISCARD',
}
for name, (_, c_name, _) in {**ENUMS, **STRUCTS}.items():
    TYPES[name] = c_name


def fail(what):
    sys.exit('generate.py: ' + what)


def read(path):
    return (ROOT / path).read_text(encoding='utf-8')


WIDTH = 120
# What comments name otherwise in C.
SAID = (('compile() and normalize() make it', 'nbc_compile makes it'), ('compile() and normalize()', 'nbc_compile'),
        ('All of normalize() but `unset`.', ''), (' (portion_walk.h)', ''), (' (final_walk.h)', ''),
        ('kFaultTexts has a sentence for each, in this order', 'nbc_fault_text has a sentence for each'),
        ('`Findings`', '`findings`'), ('·', '*'), ('²', '^2'), ('×', 'x'), ('…', '...'))


def said(words):
    words = re.sub(r' `kName` is a template argument[^.]*\.', '', ' '.join(words.split()))
    for old, new in SAID:
        words = words.replace(old, new)
    for word, constant in CONSTANTS.items():
        words = re.sub(r'\b' + word + r'\b', constant, words)
    return words.strip()


def comment(words, indent=''):
    """Words as a comment, in lines of their own. All comments are of one style, which old C compilers read, too."""
    words = said(words)
    if not words:
        return ''
    lines = textwrap.wrap(words, WIDTH - len(indent) - 6, break_long_words=False, break_on_hyphens=False)
    return indent + '/* ' + ('\n' + indent + '   ').join(lines) + ' */\n'


def with_comment(line, words):
    """A line of code and its comment: beside it, or above it where that is too long."""
    beside = line + (' /* ' + said(words) + ' */' if words else '')
    indent = line[:len(line) - len(line.lstrip())]
    return beside + '\n' if len(beside) <= WIDTH else comment(words, indent) + line + '\n'


def close_of(text, start, pair='()'):
    depth = 0
    for i in range(start, len(text)):
        depth += (text[i] == pair[0]) - (text[i] == pair[1])
        if depth == 0:
            return i
    fail('an open ' + pair[0] + ' in ' + text[start:start + 40])


def arguments(text, brackets=('([{', ')]}')):
    """The parts of a list between commas."""
    parts, depth, last = [], 0, 0
    for i, c in enumerate(text):
        depth += (c in brackets[0]) - (c in brackets[1])
        if c == ',' and depth == 0:
            parts.append(text[last:i])
            last = i + 1
    parts.append(text[last:])
    return [part.strip() for part in parts if part.strip()]


def enum_constants(name):
    """Names, values or None, comments."""
    path, _, prefix = ENUMS[name]
    found = re.search(r'enum class ' + name + r' : std::\w+ \{(.*?)\};', read(path), re.S)
    if not found:
        fail(path + ' has no enum class ' + name)
    rows = []
    for line in found.group(1).split('\n'):
        code, _, words = line.partition('//')
        for item in code.split(','):
            if item.strip():
                word, _, value = item.partition('=')
                rows.append([prefix + word.strip().upper(), value.strip(), ''])
        if words.strip() and rows:
            rows[-1][2] = (rows[-1][2] + ' ' + words.strip()).strip()
    return rows


CONSTANT_OF = {}
for name in ENUMS:
    for word, _, _ in enum_constants(name):
        CONSTANT_OF[name + '::' + word[len(ENUMS[name][2]):].lower()] = word


def c_type(kind):
    if kind in ARRAYS:
        return ARRAYS[kind]
    if kind not in TYPES:
        fail('no type in C for ' + kind)
    return TYPES[kind], ''


def tidy(text):
    """Translates comments: those in lines of their own are joined and filled."""
    lines, out = text.split('\n'), []
    i = 0
    while i < len(lines):
        found = re.match(r'( *)// ?(.*)$', lines[i])
        i += 1
        if not found:
            code, mark, words = lines[i - 1].partition(' //')
            out.append(with_comment(code.rstrip(), words.strip() if 'clang-format' not in words else '')[:-1]
                       if mark else code)
            continue
        words = [found.group(2)]
        while i < len(lines) and re.match(re.escape(found.group(1)) + '// ?', lines[i]):
            words.append(lines[i].strip()[2:].strip())
            i += 1
        if 'clang-format' in words[0] or words[0].startswith('----'):
            continue
        out += comment(' '.join(words), found.group(1)).split('\n')[:-1]
    return '\n'.join(out)


def wrapped(text):
    """Breaks long lines of code behind a comma, or else at a space, four columns further in."""
    out = []
    for line in text.split('\n'):
        indent = len(line) - len(line.lstrip())
        while len(line) > WIDTH and not line.lstrip().startswith('/*'):
            at = max(line.rfind(', ', indent + 8, WIDTH) + 1, 0) or line.rfind(' ', indent + 8, WIDTH)
            if at <= 0:
                break
            out.append(line[:at])
            line = ' ' * (indent + 4) + line[at + 1:]
        out.append(line)
    return '\n'.join(out)
