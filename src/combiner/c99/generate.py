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

sys.dont_write_bytecode = True  # no folder of compiled modules in the sources

from functions import CLASSES, SIGNATURES, class_text, expression, find_functions, function_text, steps_text
from names import (ARRAYS, COMBINER, CONSTANT_OF, CONSTANTS, ENUMS, HERE, LAYOUT, NUMERICS, PROFILE, STRUCTS, WIDTH, c_type,
                   comment, enum_constants, fail, read, with_comment, wrapped)

# The functions in the order of the C file: file, names ('*': all of the file), words for the heading, domain.
FUNCTIONS = (
    (COMBINER + 'registers.h', ('is_texture', 'texture_unit_of'), 'Registers', None),
    (NUMERICS + 'fixed9.h', ('from_byte', 'to_byte'), 'Codes and bytes', None),
    (NUMERICS + 'codes.h', ('byte_of_color',), None, None),
    (COMBINER + 'state.h', ('default_portion',), 'Defaults', None),
    ('src/combiner/state_rules.h', '*', 'Validation', None),
    (COMBINER + 'program.h', ('is_live', 'normalize_portion', 'writes', 'normalize_blue_to_alpha', 'has_mux', 'reads',
                              'reads_directly', 'normalize_final', 'stage_reads', 'final_reads'), 'Normalization', None),
    (COMBINER + 'normalize.h', ('constant_codes', 'dead_portion', 'normalize_stage', 'normalize_combiners'), None, None),
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


def functions_of(path, names):
    return list(find_functions(path)) if names == '*' else names


def datapath_fields():
    body = re.search(r'\nstruct Datapath \{\n(.*?)\n\};', read(PROFILE), re.S).group(1)
    fields = re.findall(r'^  \w+ (\w+) = ', body, re.M)
    if len(fields) + body.count('friend') != len(re.findall(r';', re.sub(r'//.*', '', body))):
        fail('cannot read the fields of Datapath in ' + PROFILE)
    return [field for field in fields if field != 'arithmetic']


def fields_macro(name, fields):
    members = ' '.join('X(%s)' % field for field in fields)
    return ' \\\n  '.join(['#define ' + name + '(X)', *textwrap.wrap(members, WIDTH - 4)]) + '\n'


def profile_fields():
    """The fields of a profile that programs depend on, in its order: those of Datapath, which have the same names there,
    and those that the functions read."""
    body = re.search(r'\nstruct HardwareProfile \{\n(.*?)\n\};', read(PROFILE), re.S).group(1)
    read_ones = set(datapath_fields())
    for path, names, _, _ in FUNCTIONS:
        for name in functions_of(path, names):
            if name not in CLASSES:
                read_ones.update(re.findall(r'\bprofile\.(\w+)', find_functions(path)[name][4]))
    return [field for field in re.findall(r'Choice<\w+> (\w+);', body) if field in read_ones]


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
    text = read(PROFILE)

    def values(body, pattern):
        return {m.group(1): m.group(2).strip() for m in re.finditer(pattern, body)}

    base = re.search(r'consteval HardwareProfile card\(\) \{(.*?)\n\}\n', text, re.S).group(1)
    geforce2 = values(base, r'\.(\w+) = \{([^,]+),')
    geforce2['name'] = re.search(r'\.name = ("[^"]*")', base).group(1)
    rows = [geforce2]
    for body in re.findall(r'consteval HardwareProfile \w+\(\) \{\n  HardwareProfile p = card\(\);\n(.*?)\n\}', text, re.S):
        row = {**geforce2, **values(body, r'p\.(\w+) = \{([^,]+),')}
        row['name'] = re.search(r'p\.name = ("[^"]*")', body).group(1)
        rows.append(row)
    lines = []
    for row in rows:
        fields = [CONSTANT_OF.get(row[field], row[field]) for field in profile_fields()]
        lines.append('    {' + row['name'] + ', ' + ', '.join(fields) + '},\n')
    return 'static const nbc_profile kProfiles[] = {\n' + ''.join(lines) + '};\n\n'


def field_ranges():
    """What a number of a profile may be, as the table of fields says: "0 to 4", "one to one + 1"."""
    text = read('src/numerics/profile_fields.cpp')

    def said(value):
        value = re.sub(r'std::max\((.*), (.*)\)$', r'the higher of \1 and \2', value.replace('.value', ''))
        return value.replace('p.', '')

    functions = {name: (said(low), said(high)) for name, low, high in re.findall(
        r'constexpr FieldNumbers (\w+)\(const HardwareProfile& p\) \{\n  return \{(.*), ([^,]*)\};\n\}', text)}
    ranges = {}
    for field, given in re.findall(r'number<&P::(\w+)>\("\w+", \w+, (numbers_of<-?\d+, -?\d+>|\w+),', text):
        numbers = re.match(r'numbers_of<(-?\d+), (-?\d+)>', given)
        if not numbers and given not in functions:
            if field in profile_fields():
                fail('profile_fields.cpp: cannot read the range of ' + field)
            continue
        low, high = numbers.groups() if numbers else functions[given]
        ranges[field] = low if low == high else low + ' to ' + high
    return ranges


def profile_struct():
    body = re.search(r'\nstruct HardwareProfile \{\n(.*?)\n\};', read(PROFILE), re.S).group(1)
    text = ''
    ranges = field_ranges()
    for field in profile_fields():
        found = re.search(r'Choice<(\w+)> ' + field + r';\s*//([^\n]*(?:\n {20,}//[^\n]*)*)', body)
        if not found:
            fail('HardwareProfile has no field ' + field)
        words = ' '.join(part.strip(' /') for part in found.group(2).split('\n'))
        if found.group(1) == 'int' and field not in ranges:
            fail('profile_fields.cpp has no range of ' + field)
        if ranges.get(field, words) not in words:
            words += '; ' + ranges[field]
        text += with_comment('  ' + c_type(found.group(1))[0] + ' ' + field + ';', words)
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
        for name in functions_of(path, names):
            code += class_text(path, name) if name in CLASSES else function_text(path, name, domain)
    header = (HERE / 'ninebit_combiner.h.in').read_text(encoding='utf-8')
    source = (HERE / 'ninebit_combiner.c.in').read_text(encoding='utf-8')
    source, findings = re.subn(r'/\* @FINDINGS \*/\n(.*?)/\* FINDINGS@ \*/\n', '', source, flags=re.S)
    part = re.search(r'/\* @FINDINGS \*/\n(.*?)/\* FINDINGS@ \*/\n',
                     (HERE / 'ninebit_combiner.c.in').read_text(encoding='utf-8'), re.S).group(1)
    code = code.replace('@FINDINGS@', part)
    for mark, text in (('@TYPES@', types), ('@PROFILE@', profile), ('@ARITHMETIC@', fields_macro('NBC_ARITHMETIC', datapath_fields())),
                       ('@CHIP@', fields_macro('NBC_CHIP', [f for f in profile_fields() if f not in datapath_fields()])),
                       ('@STATES@', states), ('@PROGRAMS@', programs),
                       ('@FAULTS@', faults), ('@CODE@', code), ('@FAULT_TEXTS@', fault_texts()),
                       ('@REGISTER_NAMES@', names_of('Register')), ('@MAPPING_NAMES@', names_of('InputMapping')),
                       ('@SCALE_NAMES@', names_of('Scale'))):
        header = header.replace(mark + '\n', text).replace(mark, text)
        source = source.replace(mark + '\n', text).replace(mark, text)
    return {'ninebit_combiner.h': clean(header), 'ninebit_combiner.c': clean(source)}


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
