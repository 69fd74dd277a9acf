"""The rules of the house. Each takes the top of a workspace and returns breaches, 'FILE:LINE: what is wrong'."""
import fnmatch
import os
import re
import subprocess

import yaml

INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]')
CODE = ('.h', '.cpp')
ABOVE = ('node', 'tools', 'example', 'benchmark', 'test')  # of a package, in whatever order


def files_of(folder, endings=CODE):
    """All files below a folder, sorted; links are not followed."""
    for root, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            if name.endswith(endings):
                yield os.path.join(root, name)


def includes_of(file):
    """(line, what is included), in order."""
    with open(file, encoding='utf-8') as text:
        for number, line in enumerate(text, 1):
            found = INCLUDE.match(line)
            if found:
                yield number, found.group(1)


def packages(top):
    return sorted(name for name in os.listdir(os.path.join(top, 'src'))
                  if os.path.isfile(os.path.join(top, 'src', name, 'package.xml')))


def doors(top):
    """Rule 1: a header in include/ that only its own package includes is no door."""
    used, inside, all_doors = set(), {}, {}
    for package in packages(top):
        folder = os.path.join(top, 'src', package)
        for file in files_of(os.path.join(folder, 'include')):
            name = os.path.relpath(file, os.path.join(folder, 'include'))
            all_doors[name] = file
            inside[name] = [included for _, included in includes_of(file)]
        for file in files_of(folder):
            own = package + '/'
            for _, included in includes_of(file):
                # What people copy from example/ is their program.
                if not included.startswith(own) or '/example/' in file:
                    used.add(included)
    # What the documents tell users to include.
    told = ''
    for file in files_of(os.path.join(top, 'docs'), ('.md',)):
        with open(file, encoding='utf-8') as text:
            told += text.read()
    used |= {name for name in all_doors if re.search(r'\b%s\b' % re.escape(os.path.basename(name)), told)}
    for file in files_of(os.path.join(top, 'tests')):
        used |= {included for _, included in includes_of(file)}
    # What a door includes is needed beside it.
    todo = list(used)
    while todo:
        for included in inside.get(todo.pop(), []):
            if included not in used:
                used.add(included)
                todo.append(included)
    return ['%s:1: no other package and no program of a user includes it: move it to src/' % file
            for name, file in sorted(all_doors.items()) if name not in used]


def ros_in_sources(top):
    """Rule 2, of the sources: ROS is included in src/ros/, node/, tools/ and tests only."""
    breaches = []
    for package in packages(top):
        if package == 'anthrob_ros':
            continue
        folder = os.path.join(top, 'src', package)
        for part in ('include', 'src'):
            for file in files_of(os.path.join(folder, part)):
                # Doors of a library that is of ROS lie under the same names in src/ros/.
                stem = os.path.splitext(os.path.basename(file))[0]
                if '/src/ros/' in file or any(os.path.splitext(os.path.basename(f))[0] == stem
                                              for f in files_of(os.path.join(folder, 'src', 'ros'))):
                    continue
                breaches += ['%s:%d: <%s> is of ROS: move it to src/ros/ or a node' % (file, line, included)
                             for line, included in includes_of(file)
                             if re.match(r'(ros|rosbag|tf2_ros|roslib|xmlrpcpp|image_transport|\w+_(msgs|srvs))/', included)]
    return breaches


def ros_in_library(library):
    """Rule 2, of what was built: a core library needs no symbol and no library of ROS."""
    needed = subprocess.run(['readelf', '-d', library], check=True, capture_output=True, text=True).stdout
    symbols = subprocess.run(['nm', '-D', '-C', '--undefined-only', library], check=True, capture_output=True, text=True).stdout
    breaches = ['%s: needs the library %s' % (library, name)
                for name in re.findall(r'NEEDED.*\[(lib(?:ros|xmlrpcpp|cpp_common|tf2)\w*\.so[^\]]*)\]', needed)]
    return breaches + ['%s: needs the symbol %s' % (library, name)
                       for name in re.findall(r'U ((?:ros|rosbag|XmlRpc|tf2_ros)::.*)', symbols)]


def place_of(file, folder, stems):
    """The folder of a package's src/ to which a file belongs; a door belongs to that of its source."""
    for part in ABOVE:
        if file.startswith(os.path.join(folder, part) + '/'):
            return None
    if file.startswith(os.path.join(folder, 'src') + '/'):
        return os.path.dirname(os.path.relpath(file, os.path.join(folder, 'src'))) or '.'
    inner = os.path.dirname(os.path.relpath(file, os.path.join(folder, 'include', os.path.basename(folder))))
    return inner or stems.get(os.path.splitext(os.path.basename(file))[0], '.')


def resolved(folder, file, included):
    package = os.path.basename(folder)
    for candidate in (os.path.join(os.path.dirname(file), included), os.path.join(folder, 'src', included),
                      os.path.join(folder, 'include', included) if included.startswith(package + '/') else ''):
        if candidate and os.path.isfile(candidate):
            return os.path.normpath(candidate)
    return None


def folders(top):
    """Rule 3: folders of a package point one way."""
    with open(os.path.join(top, 'tests', 'house', 'folders.yaml'), encoding='utf-8') as text:
        order_of = yaml.safe_load(text)
    breaches = []
    for package in packages(top):
        folder = os.path.join(top, 'src', package)
        sources = [f for part in ('include', 'src') for f in files_of(os.path.join(folder, part))]
        stems = {os.path.splitext(os.path.basename(f))[0]: os.path.dirname(os.path.relpath(f, os.path.join(folder, 'src'))) or '.'
                 for f in files_of(os.path.join(folder, 'src'), ('.cpp',))}
        order = order_of.get(package, [])

        def rank(place, order=order):
            found = [i for i, pattern in enumerate(order) if fnmatch.fnmatchcase(place, pattern)]
            return found[0] if found else None

        for file in sources:
            place = place_of(file, folder, stems)
            if rank(place) is None:
                breaches.append('%s:1: the folder %s of %s is not in tests/house/folders.yaml' % (file, place, package))
                continue
            for line, included in includes_of(file):
                target = resolved(folder, file, included)
                if target is None:
                    continue
                other = place_of(target, folder, stems)
                if other is None or (rank(other) is not None and rank(other) > rank(place)):
                    breaches.append('%s:%d: %s includes upwards, of %s' % (file, line, place, other or 'the programs'))
    return breaches


def packages_point_one_way(top):
    """What a package includes of another one, its package.xml names; and no circle is left."""
    breaches, uses = [], {}
    for package in packages(top):
        folder = os.path.join(top, 'src', package)
        with open(os.path.join(folder, 'package.xml'), encoding='utf-8') as text:
            declared = set(re.findall(r'<\w*depend>(\w+)</\w*depend>', text.read()))
        uses[package] = declared
        for file in files_of(folder):
            for line, included in includes_of(file):
                other = included.split('/')[0]
                if other.startswith('anthrob_') and '/' in included and other != package and other not in declared:
                    breaches.append('%s:%d: package.xml does not name %s' % (file, line, other))
    return breaches


RESULTS = 'Answer|Diagnosis|SearchResult|Baseline|Measurement|Admission'
FILLED = re.compile(r'(const\s+)?(?:\w+::)*\b(?:%s)& ' % RESULTS)


def filled_in(top):
    """Rule 4: stages of discovery return values, and nobody fills in a shared result."""
    breaches = []
    for file in files_of(os.path.join(top, 'src', 'anthrob_discovery')):
        if '/test/' in file:
            continue
        with open(file, encoding='utf-8') as text:
            for number, line in enumerate(text, 1):
                if any(not constant for constant in FILLED.findall(line)):
                    breaches.append('%s:%d: a result is filled in: return a value' % (file, number))
    return breaches


NUMBER = re.compile(r'\bconstexpr\b[^;=]*\bk[A-Z]\w*\s*(=\s*|\{)')


def doors_in_documents(top, page='docs/architecture.md'):
    """Rule 1, of what users are told: a header that the table of doors names can be included."""
    breaches = []
    with open(os.path.join(top, page), encoding='utf-8') as text:
        lines = text.read().splitlines()
    begin = lines.index('## Doors')
    end = next(i for i in range(begin + 1, len(lines)) if lines[i].startswith('## '))
    package = None
    for number in range(begin, end):
        cells = [cell.strip() for cell in lines[number].split('|')[1:-1]]
        if len(cells) < 3:
            continue
        package = (re.findall(r'`(anthrob_\w+)`', cells[0]) or [package])[0]
        for header in re.findall(r'`([\w/]+\.h)`', cells[1]):
            if not os.path.isfile(os.path.join(top, 'src', package, 'include', package, header)):
                breaches.append('%s:%d: %s has no %s in include/' % (os.path.join(top, page), number + 1, package, header))
    return breaches


def folders_in_documents(top, page='docs/architecture.md'):
    """A folder of a package is found on the map."""
    with open(os.path.join(top, page), encoding='utf-8') as text:
        told = text.read()
    with open(os.path.join(top, 'tests', 'house', 'folders.yaml'), encoding='utf-8') as text:
        order = yaml.safe_load(text)
    return ['%s:1: names no folder %s/, which %s has' % (os.path.join(top, page), folder, package)
            for package, listed in order.items() for folder in listed
            if re.match(r'\w+$', folder) and '`%s/`' % folder not in told]


def scattered_numbers(top, package='anthrob_discovery'):
    """Rule 5: numbers that decide stand in src/options, not beside the code that uses them."""
    breaches = []
    for part in ('include', 'src'):
        for file in files_of(os.path.join(top, 'src', package, part)):
            if os.path.basename(os.path.dirname(file)) == 'options':
                continue
            with open(file, encoding='utf-8') as text:
                breaches += ['%s:%d: a number of its own: move it to the options' % (file, number)
                             for number, line in enumerate(text, 1) if NUMBER.search(line)]
    return breaches


# The packages that rule 6 is asked of: the others still have such answers.
ANSWERING = ('anthrob_calib', 'anthrob_control', 'anthrob_core', 'anthrob_mocap', 'anthrob_recorder', 'anthrob_recording',
             'anthrob_ros')
NOTHING = re.compile(r'\breturn (?:""|-1|-1\.0);')
# Where such an answer stays: the file, how its line goes, and why.
ALLOWED_ANSWERS = (
    ('anthrob_core/src/command_line.cpp', 'value <= highest) return "";', 'CLI11 asks validators for it'),
    ('anthrob_recording/src/dataset/table_file.cpp', 'if (first == std::string::npos) return "";', 'blanks, trimmed, are this text'),
    ('anthrob_recording/src/foreign/foreign_csv.cpp', 'if (first == std::string::npos) return "";', 'blanks, trimmed, are this text'),
)


def answers(top, asked=ANSWERING):
    """Rule 6: what is missing or went wrong is a type, never an empty string or -1."""
    breaches = []
    for package in asked:
        folder = os.path.join(top, 'src', package)
        for part in ('include', 'src', 'node', 'tools'):
            for file in files_of(os.path.join(folder, part)):
                ends = [end for name, end, _ in ALLOWED_ANSWERS if file == os.path.join(top, 'src', name)]
                with open(file, encoding='utf-8') as text:
                    breaches += ['%s:%d: an answer that means none: return std::optional, or an enum' % (file, number)
                                 for number, line in enumerate(text, 1)
                                 if NOTHING.search(line) and not any(line.rstrip().endswith(end) for end in ends)]
    return breaches
