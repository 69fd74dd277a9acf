#!/usr/bin/env python3
"""Makes docs/discovery_method.md from its template and from the numbers of src/anthrob_discovery/src/options/*.h.

method_page_test.py sees to it that the page is up to date; options_test.cpp, that discovery prints the same numbers."""
import argparse
import difflib
import fractions
import pathlib
import re
import statistics
import sys
import types

TOP = pathlib.Path(__file__).resolve().parents[1]
TEMPLATE = 'docs/discovery_method.md.j2'
PAGE = 'docs/discovery_method.md'
OPTIONS = 'src/anthrob_discovery/src/options'


class Bad(Exception):
    """What is wrong with an input, in one line."""


# --- the headers -----------------------------------------------------------------------------------

STRUCT = re.compile(r'struct (\w+) \{')
MEMBER = re.compile(r'  ([A-Za-z:_]+(?:<double, \d+>)?) ([a-z_]+)(?: = ([^;]+))?;(?:\s*///< (.*))?$')


def declared(folder):
    """By the name of a struct: its reason, and its members as (type, name, text of the value, reason)."""
    structs = {}
    for file in sorted(folder.glob('*.h')):
        reason, present = [], None
        for line in file.read_text(encoding='utf-8').splitlines():
            struct, member = STRUCT.match(line), MEMBER.match(line)
            if struct:
                present = structs[struct[1]] = types.SimpleNamespace(reason=' '.join(reason), members=[])
            elif member and present:
                present.members.append((member[1], member[2], member[3], member[4] or ' '.join(reason)))
            above = re.match(r' *///(?!<) ?(.*)', line)
            reason = reason + [above[1]] if above else []
    return structs


def elements(text):
    return [part.strip() for part in text.strip('{}').split(',')]


def value_of(text):
    """Of a literal, of the ratio of two, or of a list of them."""
    if text.startswith('{'):
        return [value_of(part) for part in elements(text)]
    first, *others = [float(part) for part in text.split('/')]
    for other in others:
        first /= other
    return first


def shown(text):
    """A value as the table has it: "4 / 3" stays a ratio."""
    if '/' in text:
        return ' / '.join(number(float(part)) for part in text.split('/'))
    return ', '.join(number(value_of(part)) for part in elements(text))


def options_of(structs, name, values=(), path='', reason=''):
    """The options as a tree of values, and a list of the groups in it that have numbers of their own.
    @param values that replace those of the struct, in order"""
    if name not in structs:
        raise Bad('%s: no struct %s' % (OPTIONS, name))
    tree, rows, groups = types.SimpleNamespace(), [], []
    for k, (kind, member, text, why) in enumerate(structs[name].members):
        if kind.endswith('Options'):
            branch, below = options_of(structs, kind, elements(text) if text else (), path + member + '.', why)
            setattr(tree, member, branch)
            groups += below
            continue
        text = values[k] if k < len(values) else text
        try:
            setattr(tree, member, value_of(text))
        except (AttributeError, ValueError) as error:
            raise Bad('%s: %s%s: %s: expected a number' % (OPTIONS, path, member, text)) from error
        unit, meaning = re.match(r'(?:\[([^\]]+)\] ?)?(.*)', why).groups()
        unit = unit or ('share' if kind == 'Share' else '')
        rows.append(types.SimpleNamespace(name=member, value=shown(text), unit=unit, meaning=meaning.replace('|', '\\|')))
    told = structs[name].reason
    if rows:
        told = told if not reason else '%s: %s.' % (told.rstrip('.'), reason)
        groups.insert(0, types.SimpleNamespace(name=path.rstrip('.'), meaning=told, rows=rows))
    return tree, groups


# --- numbers in prose ------------------------------------------------------------------------------

WORDS = 'zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen ' \
        'eighteen nineteen twenty'.split()
PARTS = {2: 'half', 3: 'third', 4: 'quarter', 5: 'fifth', 10: 'tenth', 20: 'twentieth', 100: 'hundredth',
         10000: 'ten-thousandth'}


def number(value):
    """Six digits at most, and integers without a point: 2, 0.05, 1e-7, 400 000."""
    if not isinstance(value, (int, float)):
        return value
    if value == int(value):
        return format(int(value), ',').replace(',', ' ') if abs(value) >= 1e4 else str(int(value))
    return re.sub(r'e([+-])0*', lambda found: 'e' + found[1].strip('+'), '%.6g' % value)


def percent(share):
    return number(100.0 * share) + ' %'


def word(value):
    """three, as far as such words go."""
    whole = round(value, 9)
    return WORDS[int(whole)] if whole == int(whole) and 0 <= whole < len(WORDS) else number(value)


def times(value):
    return {'one': 'once', 'two': 'twice'}.get(word(value), word(value) + ' times')


def fraction(value):
    ratio = fractions.Fraction(value).limit_denominator(10000)
    return ratio if abs(float(ratio) - value) < 1e-9 else None


def part(value):
    """half, a tenth, two fifths; a number where English has no word."""
    ratio = fraction(value)
    name = PARTS.get(ratio.denominator) if ratio and ratio < 1 else None
    if name and ratio.numerator == 1:
        return name if name == 'half' else 'a ' + name
    return '%s %ss' % (word(ratio.numerator), name) if name and ratio.denominator <= 10 else number(value)


def out_of(value):
    """nineteen times out of twenty"""
    ratio = fraction(value)
    if not ratio or ratio.denominator >= len(WORDS):
        return percent(value) + ' of the time'
    return '%s out of %s' % (times(ratio.numerator), word(ratio.denominator))


def digits(value, count):
    return float('%.*g' % (count, value))


def normal_quantile(probability):
    return statistics.NormalDist().inv_cdf(probability)


def page_of(top):
    import jinja2  # here, so that its absence can be told in one line
    tree, groups = options_of(declared(top / OPTIONS), 'Options')
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(str(top)), undefined=jinja2.StrictUndefined,
                                     trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True, finalize=number)
    environment.filters.update(digits=digits, out_of=out_of, part=part, percent=percent, times=times, word=word)
    environment.globals.update(normal_quantile=normal_quantile)
    try:
        return environment.get_template(TEMPLATE).render(vars(tree), groups=groups)
    except (jinja2.TemplateError, TypeError) as error:
        raise Bad('%s:%d: %s' % (TEMPLATE, line_of(error), error)) from error


def line_of(error):
    """The line of the template; jinja2 tells it in the traceback."""
    if hasattr(error, 'lineno'):
        return error.lineno
    line, trace = 0, error.__traceback__
    while trace:
        if trace.tb_frame.f_code.co_filename.endswith(TEMPLATE):
            line = trace.tb_lineno
        trace = trace.tb_next
    return line


# --- the page --------------------------------------------------------------------------------------

def differences(old, new):
    """Where the lines of two pages differ, by lines of the old one."""
    for kind, a, b, c, d in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if kind != 'equal':
            yield '%s:%d: %s' % (PAGE, a + 1, ' '.join(old[a:b]) or '(nothing)')
            yield '    expected: %s' % (' '.join(new[c:d]) or '(nothing)')


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('--check', action='store_true', help='only tell where the page differs; exit with 1 if it does')
    arguments = parser.parse_args()
    page = TOP / PAGE
    try:
        text = page_of(TOP)
        if not arguments.check:
            page.write_text(text, encoding='utf-8')
            return 0
        told = list(differences(page.read_text(encoding='utf-8').splitlines(), text.splitlines()))
    except Bad as error:
        print('method_page.py: %s' % error, file=sys.stderr)
        return 2
    except OSError as error:
        print('method_page.py: %s: %s' % (error.filename, error.strerror), file=sys.stderr)
        return 2
    except ImportError:
        print('method_page.py: python3-jinja2 is missing: install it (apt install python3-jinja2)', file=sys.stderr)
        return 2
    print('\n'.join(told + ['%s is not what template and options make: run scripts/method_page.py' % PAGE]) if told
          else '%s is up to date' % PAGE)
    return 1 if told else 0


if __name__ == '__main__':
    sys.exit(main())
