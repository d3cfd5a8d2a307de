#!/usr/bin/env python3
"""Writes ninebit_combiner.h and ninebit_combiner.c, the register combiners in C99, from the rules that the library's C++
has: types, profiles, validation, normalization, arithmetic, the walks, the layout of register words. One definition
stays; nothing of it is copied by hand.

  generate.py           writes both files beside this one
  generate.py --check   compares them with what it would write; exit 1: they differ

It translates a part of C++: plain structs and enumerations, constexpr functions without lambdas, and the two classes of
evaluate.h. Their text must fit; where it does not, a message names it, or the C compiler of the tests does. What is no
rule, the interface of the two files, stands in *.in.
"""
import re
import sys
import textwrap
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
COMBINER = 'include/ninebit/combiner/'
NUMERICS = 'include/ninebit/numerics/'
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
    'Narrowing': (NUMERICS + 'hardware_profile.h', 'nbc_narrowing', 'NBC_NARROW_'),
    'NarrowingPoint': (NUMERICS + 'hardware_profile.h', 'nbc_narrowing_point', 'NBC_NARROW_'),
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
# Fields of a profile that programs depend on. Those of Datapath have the same names there.
PROFILE_FIELDS = ('one', 'lowest', 'lowest_output', 'half', 'expand_offset', 'byte_shift', 'general_narrowing',
                  'narrowing_point', 'final_narrowing', 'general_combiners', 'texture_units', 'per_stage_constants',
                  'blue_to_alpha', 'mux_by_lowest_bit', 'color_sum_inverts')
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

# The functions in the order of the C file: file, names ('*': all of the file), words for the heading, domain.
FUNCTIONS = (
    (COMBINER + 'registers.h', ('is_texture', 'texture_unit_of'), 'Registers', None),
    (NUMERICS + 'fixed9.h', ('from_byte', 'to_byte', 'byte_of_color'), 'Codes and bytes', None),
    (COMBINER + 'state.h', ('default_portion',), 'Defaults', None),
    ('src/combiner/state_rules.h', '*', 'Validation', None),
    (COMBINER + 'program.h', ('is_live', 'normalize_portion', 'writes', 'normalize_blue_to_alpha', 'has_mux', 'reads',
                              'reads_directly', 'normalize_final', 'stage_reads', 'final_reads', 'constant_codes',
                              'dead_portion', 'normalize_stage', 'normalize_combiners'), 'Normalization', None),
    (COMBINER + 'evaluate.h', ('set', 'add', 'sub', 'mul', 'min_of', 'max_of', 'abs_of', 'divide',
                               'negate_where_negative', 'select_where_at_least'), 'Primitives', None),
    (COMBINER + 'arithmetic.inl', '*', 'Arithmetic', None),
    (COMBINER + 'evaluate.h', ('fetch',), 'Values of inputs', None),
    (COMBINER + 'portion_walk.h', ('component_of', 'first_component', 'end_component', 'register_of',
                                   'copies_to_alpha'), None, None),
    (COMBINER + 'evaluate.h', ('CodeDomain',), 'General combiners', None),
    (COMBINER + 'portion_walk.h', ('compute_product', 'compute_portion', 'write_portion', 'walk_stage'), None, 'codes'),
    (COMBINER + 'evaluate.h', ('FinalCodes',), 'Final combiner', None),
    (COMBINER + 'final_walk.h', ('final_input', 'walk_final'), None, 'final_codes'),
    (LAYOUT, ('bits', 'read_input', 'read_output', 'read_final_flags', 'leave_out_final_combiner', 'has_mux',
              'color_of'), 'Register words', None),
)
RENAMED = {(LAYOUT, 'has_mux'): 'output_has_mux'}
CLASSES = {'CodeDomain': 'codes', 'FinalCodes': 'final_codes'}
DOMAIN_TYPES = {'codes': 'nbc_codes', 'final_codes': 'nbc_final_codes'}


def fail(what):
    sys.exit('generate.py: ' + what)


def read(path):
    return (ROOT / path).read_text(encoding='utf-8')


WIDTH = 120
# What comments name otherwise in C.
SAID = (('compile() and normalize() make it', 'nbc_compile makes it'), ('compile() and normalize()', 'nbc_compile'),
        ('All of normalize() but `unset`.', ''), (' (portion_walk.h)', ''), (' (final_walk.h)', ''),
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


# ---- Enumerations and structs ----------------------------------------------------------------------------------------

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


def enum_text(name):
    path, c_name, _ = ENUMS[name]
    about = re.search(r'((?://[^\n]*\n)*)enum class ' + name + r' ', read(path)).group(1)
    text = comment(' '.join(line.strip('/ ') for line in about.split('\n')))
    text += 'typedef ' + ('uint16_t' if name == 'GlError' else 'uint8_t') + ' ' + c_name + ';\nenum {\n'
    rows = enum_constants(name)
    for word, value, words in rows:
        last = word == rows[-1][0]
        text += with_comment('  ' + word + (' = ' + value if value else '') + ('' if last else ','), words)
    return text + '};\n\n'


CONSTANT_OF = {}
for name in ENUMS:
    for word, _, _ in enum_constants(name):
        CONSTANT_OF[name + '::' + word[len(ENUMS[name][2]):].lower()] = word


def struct_members(name):
    """Type, name, size of an array in C, initializer in C++ or None, comment."""
    path, _, left_out = STRUCTS[name]
    found = re.search(r'\nstruct ' + name + r' \{\n(.*?)\n\};', read(path), re.S)
    if not found:
        fail(path + ' has no struct ' + name)
    body, rows, above = found.group(1), [], ''
    body = re.sub(r'\n *friend [^;]*;', '', body)
    begun = ''  # of a declaration that goes on in the next line
    for line in body.split('\n'):
        code, _, words = line.partition('//')
        code = begun + ' ' + code.strip() if begun else code
        begun = code.strip() if code.strip() and not code.rstrip().endswith(';') else ''
        if begun:
            continue
        if not code.strip():
            if rows and re.match(r' {20,}', line):
                rows[-1][4] += ' ' + words.strip()
            elif words.strip():
                above = (above + ' ' + words.strip()).strip()
            continue
        declared = re.match(r'\s*((?:std::)?\w+(?:<[^;={]*>)?) (\w+(?:, \w+|\{\}, \w+)*)(?: = (.*?)|(\{.*\}))?;\s*$', code)
        if not declared:
            fail(name + ': cannot read ' + code.strip())
        kind, names, value = declared.group(1), declared.group(2).replace('{}', ''), declared.group(3) or declared.group(4)
        words = (above + ' ' + words.strip()).strip()
        above = ''
        for one in names.split(','):
            if one.strip() in left_out:
                continue
            array = re.match(r'std::array<(\w+), (\w+)>$', kind)
            size = '[' + CONSTANTS[array.group(2)] + ']' if array else ''
            rows.append([array.group(1) if array else kind, one.strip(), size, value, words])
            words = ''
    return rows


def c_type(kind):
    if kind in ARRAYS:
        return ARRAYS[kind]
    if kind not in TYPES:
        fail('no type in C for ' + kind)
    return TYPES[kind], ''


def struct_text(name):
    path, c_name, _ = STRUCTS[name]
    about = re.search(r'((?://[^\n]*\n)*)struct ' + name + r' \{', read(path)).group(1)
    text = comment(' '.join(line.strip('/ ') for line in about.split('\n')))
    text += 'typedef struct ' + c_name + ' {\n'
    for kind, member, size, _, words in struct_members(name):
        base, rest = c_type(kind)
        text += with_comment('  ' + base + ' ' + member + size + rest + ';', words)
    return text + '} ' + c_name + ';\n\n'


def default_text(name):
    """The function that gives a struct its members' initializers."""
    c_name = STRUCTS[name][1]
    lines = []
    for kind, member, size, value, _ in struct_members(name):
        at = 'x.' + member
        loop = ''
        if size:
            loop, at = 'for (i = 0; i < ' + size[1:-1] + '; ++i) ', at + '[i]'
        if kind in ARRAYS:
            lines.append('for (i = 0; i < 4; ++i) ' + at + '[i] = 0;')
        elif kind in STRUCTS and value in (None, '{}'):
            lines.append(loop + at + ' = default_' + STRUCTS[kind][1] + '();')
        elif kind == 'Datapath':
            lines.append(at + ' = kProfiles[0];')
        elif value is None:
            fail(name + '::' + member + ' has no initializer')
        else:
            lines.append(loop + at + ' = ' + expression(value if value[0] != '{' else kind + value) + ';')
    counter = '  int i;\n' if any('++i' in line for line in lines) else ''
    return ('static ' + c_name + ' default_' + c_name + '(void) {\n  ' + c_name + ' x;\n' + counter +
            ''.join('  ' + line + '\n' for line in lines) + '  return x;\n}\n\n')


def profiles_text():
    text = read(NUMERICS + 'hardware_profile.h')

    def values(body, pattern):
        return {m.group(1): m.group(2).strip() for m in re.finditer(pattern, body)}

    base = re.search(r'inline constexpr HardwareProfile geforce2\{(.*?)\n\};', text, re.S).group(1)
    geforce2 = values(base, r'\.(\w+) = \{([^,]+),')
    geforce2['name'] = re.search(r'\.name = ("[^"]*")', base).group(1)
    rows = [geforce2]
    for body in re.findall(r'consteval HardwareProfile \w+\(\) \{\n  HardwareProfile p = geforce2;\n(.*?)\n\}', text, re.S):
        row = {**geforce2, **values(body, r'p\.(\w+) = \{([^,]+),')}
        row['name'] = re.search(r'p\.name = ("[^"]*")', body).group(1)
        rows.append(row)
    lines = []
    for row in rows:
        fields = [CONSTANT_OF.get(row[field], row[field]) for field in PROFILE_FIELDS]
        lines.append('    {' + row['name'] + ', ' + ', '.join(fields) + '},\n')
    return 'static const nbc_profile kProfiles[] = {\n' + ''.join(lines) + '};\n\n'


def profile_struct():
    path = NUMERICS + 'hardware_profile.h'
    body = re.search(r'\nstruct HardwareProfile \{\n(.*?)\n\};', read(path), re.S).group(1)
    text = ''
    for field in PROFILE_FIELDS:
        found = re.search(r'Choice<(\w+)> ' + field + r';\s*//([^\n]*(?:\n {20,}//[^\n]*)*)', body)
        if not found:
            fail('HardwareProfile has no field ' + field)
        words = ' '.join(part.strip(' /') for part in found.group(2).split('\n'))
        text += with_comment('  ' + c_type(found.group(1))[0] + ' ' + field + ';', words)
    return text


# ---- Expressions and functions ---------------------------------------------------------------------------------------

SIGNATURES = {}  # by C name: for each parameter 'pointer', 'array' or 'value'
SIGNATURES['make_nbc_input'] = ['value'] * 3
SIGNATURES['make_nbc_target'] = ['pointer', 'value', 'value']
SIGNATURES['findings_add'] = ['pointer', 'value', 'value']


def expression(text, pointers=(), domain=None):
    """A statement or an expression in C."""
    text = re.sub(r'\b(detail|reference|rules|words)::', '', text)
    text = re.sub(r'static_cast<std::size_t>\(([\w.]+)\)', r'\1', text)
    text = re.sub(r'static_cast<([\w:]+)>\(', lambda m: '(' + c_type(m.group(1))[0] + ')(', text)
    text = re.sub(r'\bdomain\.(\w+)\(', lambda m: (domain or '?') + '_' + m.group(1) + '(domain, ', text)
    text = re.sub(r'\bfindings\.(\w+)\(', r'findings_\1(findings, ', text)
    text = re.sub(r'\b([A-Z]\w+)::(\w+)\b', lambda m: CONSTANT_OF.get(m.group(0), m.group(0)), text)
    text = re.sub(r'\b(compute_product|compute_portion|write_portion)<(\w+)>\(', r'\1(\2, ', text)
    for word, constant in CONSTANTS.items():
        text = re.sub(r'\b' + word + r'\b', constant, text)
    for kind in ('CombinerInput', 'Target'):
        text = re.sub(r'\b' + kind + r'\{\}', 'default_' + TYPES[kind] + '()', text)
        text = re.sub(r'\b' + kind + r'\{([^{}]*)\}', 'make_' + TYPES[kind] + r'(\1)', text)
    text = re.sub(r'\.value\b(?!\()', '', text)
    text = re.sub(r'\((int|\w+_t|nbc_\w+|float|double)\)\(([\w.]+)\)', r'(\1)\2', text)
    text = calls(text, pointers)
    for pointer in sorted(pointers, key=len, reverse=True):
        text = re.sub(r'(?<![\w.>])' + re.escape(pointer) + r'\.', lambda m: pointer + '->', text)
    return text


def calls(text, pointers):
    """Passes addresses where a function takes a reference."""
    out, at = '', 0
    for found in re.finditer(r'\b(\w+)\(', text):
        if found.start() < at or found.group(1) not in SIGNATURES:
            continue
        end = close_of(text, found.end() - 1)
        parts = [calls(part, pointers) for part in arguments(text[found.end():end])]
        kinds = SIGNATURES[found.group(1)]
        if len(parts) != len(kinds):
            fail('%s takes %d arguments: %s' % (found.group(1), len(kinds), text[found.start():end + 1]))
        parts = ['&' + part if kind == 'pointer' and part not in pointers and not part.startswith('&') else part
                 for part, kind in zip(parts, kinds)]
        out += text[at:found.end()] + ', '.join(parts)
        at = end
    return out + text[at:]


def parameter(text):
    """C's declaration of a parameter, its name, and its kind in SIGNATURES."""
    text = re.sub(r'\b(detail|reference)::', '', text.split(' = ')[0])
    found = re.match(r'(const )?((?:typename )?[\w:]+(?:<[^<>]*>)?)(&?)(?: (\w+))?$', text)
    if not found:
        fail('cannot read the parameter ' + text)
    const, kind, reference, name = found.groups()
    name = name or 'unused'
    if kind == 'Domain':
        return None, name, 'pointer'
    if kind in ARRAYS:
        base, size = ARRAYS[kind]
        # An array of arrays that is const takes no array of arrays that is not, in C.
        return ('' if kind == 'RegisterFile' else const or '') + base + ' ' + name + size, name, 'array'
    base = c_type(kind)[0]
    if reference and kind not in BY_VALUE:
        return (const or '') + base + ' *' + name, name, 'pointer'
    return base + ' ' + name, name, 'value'


def function_head(kind, name, parameters, domain, template):
    """C's head of a function; its pointers; the array that it returns."""
    declared, kinds, pointers = [], [], set()
    if 'PortionName kName' in template:
        declared.append('nbc_portion_name kName')
        kinds.append('value')
    for part in arguments(parameters, ('<', '>')):
        text, word, how = parameter(part)
        declared.append(text or DOMAIN_TYPES[domain] + ' *domain')
        kinds.append(how)
        if how == 'pointer':
            pointers.add(word)
        if re.match(r'const (detail::)?Target&', part):
            pointers.add(word + '.out')
    kind = kind.replace('typename Domain::Input', 'V')
    returned = None
    if kind in ARRAYS:
        returned = ARRAYS[kind]
    return (('void' if returned else c_type(kind)[0]) + ' ' + name, declared, kinds, pointers, returned)


def statements(body, pointers, domain, returned):
    """The text between a function's braces."""
    body = re.sub(r'\n *if constexpr \(requires.*?\n  \}(?=\n)', '', body, flags=re.S)
    body = re.sub(r'Domain::kEveryStep \|\| ', '', body)
    body = re.sub(r'typename Domain::Wide', 'V', body)
    body = re.sub(r'\bconstexpr int\b', 'const int', body)
    body = re.sub(r'\bconst auto (\w+) = static_cast<std::size_t>', r'const int \1 = static_cast<std::size_t>', body)
    array = None
    if returned:
        found = re.search(r'\n *(\w+) (\w+)\{\};\n', body)
        array = found.group(2)
        body = body.replace(found.group(0), '\n', 1)
        body = re.sub(r'\n *return ' + array + ';', '', body)
    pointers = set(pointers)

    def local(found):
        const, kind, name, value = found.groups()
        pointers.add(name)
        return (const or '') + c_type(kind)[0] + ' *' + name + ' = &' + value + ';'

    # Local references become pointers; an element of an array of constants needs no const.
    body = re.sub(r'(const )?([\w:]+(?:<\w+>)?)& (\w+) = ([^;]+);', local, body)
    for kind in list(STRUCTS):
        body = re.sub(r'(\n *)' + kind + r' (\w+);', lambda m, k=kind: m.group(1) + TYPES[k] + ' ' + m.group(2) +
                      ' = default_' + TYPES[k] + '();', body)
        body = re.sub(r'\bconst ' + kind + r' (?=\w+ = )', 'const ' + TYPES[kind] + ' ', body)
    for kind in ('V', 'Register', 'ComponentUsage', 'StateFault', 'std::size_t'):
        body = re.sub(r'(?<![\w<:])' + kind + r' (?=\w+ = )', TYPES[kind] + ' ', body)
    body = re.sub(r'= \{([^{}]*)\};', r'= CombinerInput{\1};', body)
    # A function that returns an array gets it as its last argument.
    body = re.sub(r'([\w.]+) = (constant_codes)\((.*?)\);(?=\n)', r'\2(\3, \1);', body, flags=re.S)
    lines = []
    for line in re.split(r'(//[^\n]*)', body):
        lines.append(line if line.startswith('//') else expression(line, pointers, domain))
    return ''.join(lines)


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


def find_functions(path):
    """Comment, template, type, name, parameters, body of each function at the top level."""
    text = read(path)
    pattern = re.compile(r'((?:^//[^\n]*\n)*)^(template <[^\n]*>\n)?(?:\[\[nodiscard\]\] )?'
                         r'(?:constexpr|NINEBIT_RULE) ((?:typename )?[\w:]+) (\w+)\(', re.M)
    found = {}
    for m in pattern.finditer(text):
        end = close_of(text, m.end() - 1)
        brace = text.index('{', end)
        if text[end + 1:brace].strip():
            fail(path + ': ' + m.group(4) + ' is not a plain function')
        last = close_of(text, brace, '{}')
        parameters = re.sub(r'\s+', ' ', text[m.end():end])
        found[m.group(4)] = (m.group(1), m.group(2) or '', m.group(3), parameters, text[brace + 1:last])
    return found


def function_text(path, name, domain):
    functions = find_functions(path)
    if name not in functions:
        fail(path + ' has no function ' + name)
    words, template, kind, parameters, body = functions[name]
    c_name = RENAMED.get((path, name), name)
    head, declared, kinds, pointers, returned = function_head(kind, c_name, parameters, domain, template)
    body = statements(body, pointers, domain, returned)
    if returned:
        array = re.search(r'\n *\w+ (\w+)\{\};', functions[name][4]).group(1)
        declared.append(returned[0] + ' ' + array + returned[1])
        kinds = kinds + ['array']
    SIGNATURES[c_name] = kinds
    return tidy(words) + 'static ' + head + '(' + (', '.join(declared) or 'void') + ') {' + tidy(body) + '}\n\n'


def class_text(path, name):
    """A value domain: a struct, and a function for each member function."""
    domain, c_name = CLASSES[name], DOMAIN_TYPES[CLASSES[name]]
    found = re.search(r'((?://[^\n]*\n)*)class ' + name + r' \{(.*?)\n\};', read(path), re.S)
    body = found.group(2)
    private = body[body.index(' private:'):]
    members = re.findall(r'\n  (const )?(\w+)(&?) (\w+_);', private)
    text = tidy(found.group(1)) + 'typedef struct {\n'
    for const, kind, _, member in members:
        if kind == 'RegisterFile':
            text += '  int16_t (*' + member + ')[4];\n'
        else:
            text += '  ' + const + TYPES[kind] + ' *' + member + ';\n'
    text += '} ' + c_name + ';\n\n'
    methods = re.finditer(r'\n  constexpr (\w+) (\w+)\(([^()]*)\)(?: const)? \{(.*?)(?:\n  \}| \})(?=\n)', body, re.S)
    for m in sorted(methods, key=lambda one: ' map(' in one.group(4)):  # C declares before use
        kind, method, parameters, inner = m.groups()
        own = [part if ' ' in part.replace('const ', '') else part + ' unused' for part in arguments(parameters)]
        head, declared, kinds, pointers, _ = function_head(kind, domain + '_' + method, ', '.join(own), domain, '')
        SIGNATURES[domain + '_' + method] = ['pointer'] + kinds
        inner = re.sub(r'(?<![\w.:])map\(', domain + '_map(this, ', inner)
        for _, _, _, member in members:
            inner = re.sub(r'\b' + member + r'(?!\w)', 'self->' + member, inner)
            pointers.add('self->' + member)
        inner = statements('\n' + inner.strip('\n ') + '\n', pointers | {'this'}, domain, None).replace('this', 'self')
        used = ''.join('  (void)' + word + ';\n' for word, needed in
                       [('self', 'self' in inner), ('unused', 'unused' not in declared and not any(
                           one.endswith(' unused') for one in declared))] if not needed)
        lines = ''.join('  ' + line.strip() + '\n' if not line.startswith('    ') else line[2:] + '\n'
                        for line in inner.strip('\n').split('\n'))
        const = '' if method == 'write' else 'const '
        text += ('static ' + head + '(' + ', '.join([const + c_name + ' *self'] + declared) + ') {\n' + used + lines +
                 '}\n\n')
    return text


def heading(words):
    return '/* ---- ' + words + ' ' + '-' * (108 - len(words)) + ' */\n\n' if words else ''


def fault_texts():
    rows = re.findall(r'\{GlError::(\w+), "([^"]*)"\}', read('src/combiner/state_rules.h'))
    if len(rows) != len(enum_constants('StateFault')):
        fail('kFaultTexts and StateFault differ in length')
    return ''.join('    {NBC_GL_' + error.upper() + ', "' + text + '"},\n' for error, text in rows)


def names_of(kind):
    body = re.search(r'name_of\(' + kind + r' \w+\) \{.*?names\{(.*?)\};', read('src/combiner/registers.cpp'), re.S)
    return ', '.join(re.findall(r'"[^"]*"', body.group(1)))


def layout_constants():
    text = ''
    for line in re.findall(r'\ninline constexpr int ([^;]*);', read(LAYOUT)):
        if re.match(r'k\w+ = \d', line):
            text += ''.join('  ' + one.strip() + ',\n' for one in line.split(','))
    return 'enum {\n' + text.rstrip(',\n') + '\n};\n\n'


def register_codes():
    rows = re.search(r'kRegisters\{(.*?)\};', read(LAYOUT), re.S).group(1)
    return ', '.join(expression(part.strip()) for part in rows.split(','))


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


def generate():
    types = ''.join(enum_text(name) for name in
                    ('Register', 'InputMapping', 'ComponentUsage', 'Scale', 'Bias', 'PortionName', 'Variable',
                     'Narrowing', 'NarrowingPoint'))
    profile = profile_struct()
    states = ''.join(struct_text(name) for name in STRUCTS if name not in ('ProgramStage', 'Program'))
    programs = ''.join(struct_text(name) for name in ('ProgramStage', 'Program'))
    faults = ''.join(enum_text(name) for name in ('GlError', 'StateParameter', 'StateFault'))
    code, defaults_done = '', False
    for path, names, words, domain in FUNCTIONS:
        if path == COMBINER + 'state.h' and not defaults_done:
            code += heading('Profiles and defaults') + profiles_text()
            code += ''.join(default_text(name) for name in ('CombinerInput', 'PortionOutput', 'Portion'))
            defaults_done, words = True, None
        if path == 'src/combiner/state_rules.h':
            code += ''.join(default_text(name) for name in ('GeneralCombiner', 'FinalCombiner', 'CombinerState',
                                                            'ProgramStage', 'Program'))
        code += heading(words)
        if path == 'src/combiner/state_rules.h':
            code += '@FINDINGS@'
            SIGNATURES.update({'findings_at_parameter': ['pointer', 'value'],
                               'findings_at_variable': ['pointer', 'value', 'value', 'value'],
                               'findings_at_output': ['pointer', 'value', 'value'],
                               'findings_at_final': ['pointer', 'value']})
        if words == 'Normalization':
            code += ('/* The arithmetic of a profile. */\nstatic nbc_profile datapath_of(const nbc_profile *profile) {\n'
                     '  return *profile;\n}\n\n')
            SIGNATURES['datapath_of'] = ['pointer']
        if words == 'Register words':
            code += layout_constants()
            code += ('static const nbc_register kRegisters[16] = {' + register_codes() + '};\n\n')
        if path == COMBINER + 'portion_walk.h' and domain is None:
            code += '/* One of a portion\'s outputs in one of its channels. */\ntypedef struct {\n  const nbc_output *out;\n'
            code += '  int k; /* 0 AB, 1 CD, 2 the third: sum or mux */\n  int component; /* that the channel writes */\n'
            code += '} nbc_target;\n\nstatic nbc_target make_nbc_target(const nbc_output *out, int k, int component) {\n'
            code += '  nbc_target target;\n  target.out = out;\n  target.k = k;\n  target.component = component;\n'
            code += '  return target;\n}\n\n'
        if domain == 'codes':
            code += steps_text('ChannelSteps', 'nbc_channel', COMBINER + 'portion_walk.h')
        if domain == 'final_codes':
            code += steps_text('FinalSteps', 'nbc_final_steps', COMBINER + 'final_walk.h')
        for name in list(find_functions(path)) if names == '*' else names:
            code += class_text(path, name) if name in CLASSES else function_text(path, name, domain)
    header = (HERE / 'ninebit_combiner.h.in').read_text(encoding='utf-8')
    source = (HERE / 'ninebit_combiner.c.in').read_text(encoding='utf-8')
    source, findings = re.subn(r'/\* @FINDINGS \*/\n(.*?)/\* FINDINGS@ \*/\n', '', source, flags=re.S)
    part = re.search(r'/\* @FINDINGS \*/\n(.*?)/\* FINDINGS@ \*/\n',
                     (HERE / 'ninebit_combiner.c.in').read_text(encoding='utf-8'), re.S).group(1)
    code = code.replace('@FINDINGS@', part)
    for mark, text in (('@TYPES@', types), ('@PROFILE@', profile), ('@STATES@', states), ('@PROGRAMS@', programs),
                       ('@FAULTS@', faults), ('@CODE@', code), ('@FAULT_TEXTS@', fault_texts()),
                       ('@REGISTER_NAMES@', names_of('Register')), ('@MAPPING_NAMES@', names_of('InputMapping')),
                       ('@SCALE_NAMES@', names_of('Scale'))):
        header = header.replace(mark + '\n', text).replace(mark, text)
        source = source.replace(mark + '\n', text).replace(mark, text)
    return {'ninebit_combiner.h': clean(header), 'ninebit_combiner.c': clean(source)}


def steps_text(name, c_name, path):
    found = re.search(r'((?://[^\n]*\n)*)template <class Domain>\nstruct ' + name + r' \{\n(.*?)\n\};', read(path), re.S)
    text = tidy(found.group(1)) + 'typedef struct {\n'
    for line in found.group(2).split('\n'):
        code, _, words = line.partition('//')
        inner = re.match(r'\s*std::array<std::array<typename Domain::\w+, (\d)>, (\d)> (\w+)\{\};', code)
        array = re.match(r'\s*std::array<typename Domain::\w+, (\d)> ([\w{}, ]+);', code)
        plain = re.match(r'\s*typename Domain::\w+ (\w+)\{\};', code)
        if inner:
            text += '  int ' + inner.group(3) + '[' + inner.group(2) + '][' + inner.group(1) + '];'
        elif array:
            text += '  int ' + ', '.join(one.strip().replace('{}', '[' + array.group(1) + ']')
                                         for one in array.group(2).split(',')) + ';'
        elif plain:
            text += '  int ' + plain.group(1) + ';'
        else:
            fail(name + ': cannot read ' + line)
        text = text[:text.rindex('\n') + 1] + with_comment(text[text.rindex('\n') + 1:], words)
    return text + '} ' + c_name + ';\n\n'


def clean(text):
    text = wrapped(text)
    return re.sub(r'\n{3,}', '\n\n', text).rstrip('\n') + '\n'


def main():
    files = generate()
    different = [name for name, text in files.items()
                 if not (HERE / name).exists() or (HERE / name).read_text(encoding='utf-8') != text]
    if sys.argv[1:] == ['--check']:
        for name in different:
            print('src/combiner/c99/%s is not what generate.py writes; run it' % name)
        return 1 if different else 0
    if sys.argv[1:]:
        fail('unknown argument ' + sys.argv[1] + "; expected nothing or --check")
    for name in different:
        (HERE / name).write_text(files[name], encoding='utf-8')
        print(HERE / name)
    return 0


if __name__ == '__main__':
    sys.exit(main())
