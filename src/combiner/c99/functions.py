"""Functions and classes of C++ as C99, for generate.py. The text must be of the part of C++ that it names."""
import re

from names import (ARRAYS, BY_VALUE, CONSTANT_OF, CONSTANTS, LAYOUT, STRUCTS, TYPES, arguments, c_type, close_of, fail, read,
                   tidy, with_comment)

RENAMED = {(LAYOUT, 'has_mux'): 'output_has_mux'}
CLASSES = {'CodeDomain': 'codes', 'FinalCodes': 'final_codes'}
DOMAIN_TYPES = {'codes': 'nbc_codes', 'final_codes': 'nbc_final_codes'}

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
