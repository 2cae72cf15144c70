"""Small faults that a programmer could make, found in C++ text: flipped signs, factors of 2 and 1/2, dropped terms and statements, swapped components,
shifted comparisons, min for max. Works on the layout that clang-format gives: binary operators stand between blanks."""
import dataclasses
import hashlib
import random
import re


@dataclasses.dataclass(frozen=True)
class Mutant:
    file: str  # below the repository's root
    begin: int  # place in the text
    end: int
    new: str
    old: str
    kind: str
    line: int
    column: int  # in `source`
    source: str  # the line it begins in, without the blanks around
    copy: int = 0  # of lines that are alike in a file, the first, second, ...

    @property
    def id(self) -> str:
        """Stays the same while its line does, wherever that goes in the file."""
        what = (self.file, self.source, str(self.column), str(self.copy), self.old, self.new)
        return hashlib.sha1("\0".join(what).encode()).hexdigest()[:12]

    def applied(self, text: str) -> str:
        if text[self.begin:self.end] != self.old:
            raise ValueError(f"{self.file}:{self.line} is not what it was")
        return text[:self.begin] + self.new + text[self.end:]

    def __str__(self) -> str:
        old, new = (" ".join(part.split()) or "nothing" for part in (self.old, self.new))
        return f"{self.file}:{self.line}  {old} -> {new}  ({self.kind})    in: {self.source}"


def _blanked(text: str, spans) -> str:
    characters = list(text)
    for begin, end in spans:
        for k in range(begin, end):
            if characters[k] != "\n":
                characters[k] = " "
    return "".join(characters)


def _closing(code: str, opening: int) -> int:
    """Where the bracket that opens there is closed; the end of the text where it is not."""
    depth = 0
    for k in range(opening, len(code)):
        depth += (code[k] in "([{") - (code[k] in ")]}")
        if depth == 0:
            return k
    return len(code) - 1


def _code(text: str) -> str:
    """The text with blanks for what is not mutated: comments, strings, directives, declarations of templates and types, and what words errors."""
    not_code = r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*'
    code = _blanked(text, (found.span() for found in re.finditer(not_code, text, re.S | re.M)))
    whole = r"\b(?:throw|static_assert|using|friend)\b[^;]*;|\b(?:namespace|concept|requires)\b[^;{]*[;{]|\btemplate <[^;{]*[;{]"
    code = _blanked(code, (found.span() for found in re.finditer(whole, code)))
    # Loops of one index too many read what is not theirs: that is for sanitizers, not for tests.
    calls = re.finditer(r"\b(?:fmt::format|log_\w+|report_\w+|lap|reserve|operator|assert|for )\(|\bcore::\w*Error\b[({]", code)
    return _blanked(code, [(found.start(), _closing(code, found.end() - 1) + 1) for found in calls])


def _end_of_term(code: str, begin: int) -> int | None:
    """Where the term that begins there ends: before the next sum, comparison or comma, or at the end of its bracket."""
    stop = re.compile(r"[)\]},;]|\s+(?:[-+<>?:]|[<>=!]=|&&|\|\|)\s")
    k = begin
    while k < len(code):
        if code[k] in "([{":
            k = _closing(code, k)
        elif stop.match(code, k):
            return k
        k += 1
    return None


def _flipped(code: str):
    opposite = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
    for found in re.finditer(r"(?<=[\w)\]}] )(\+=?|-=?)(?=\s)", code):
        yield found.span(), opposite[found[0]], "sign"
    for found in re.finditer(r"(?:(?<=[(,=?:\[{] )|(?<=[(\[{])|(?<=return ))-(?=[\w(])", code):
        yield found.span(), "", "sign"


def _counts(code: str, place: int) -> bool:
    """Whether its line is about numbers of things, which factors of a half only keep from compiling."""
    line = code[code.rfind("\n", 0, place) + 1:code.find("\n", place)]
    return re.search(r"\b(?:std::size_t|std::u?int\d+_t|Index|int|bool)\b|\.size\(\)", line) is not None or _in_index(code, place)


def _factors(code: str):
    for found in re.finditer(r"(?<![\w.])\d+\.\d+(?![\w.])|(?<![\w.])\d+(?= [*/] )|(?<= [*/] )\d+(?![\w.])", code):
        value = float(found[0])
        if value == 0 or not 1e-3 <= value <= 1e3:
            continue
        whole = "." not in found[0]
        if whole and _counts(code, found.start()):
            continue
        for factor in (2, 0.5):
            scaled = value * factor
            yield found.span(), str(int(scaled)) if whole and scaled == int(scaled) else repr(scaled), "factor"
    for found in re.finditer(r"(?<=[\w)\]] )\*(?= [\w(])", code):
        before = code[:found.start()].rstrip()
        if not re.search(r"(?<![\w.])\d+$", before) and not _counts(code, found.start()):
            yield found.span(), "* 2.0 *", "factor"
            yield found.span(), "* 0.5 *", "factor"


def _in_index(code: str, place: int) -> bool:
    """Whether it stands in square brackets of the same statement."""
    begin = max(code.rfind(";", 0, place), code.rfind("{", 0, place), code.rfind("\n\n", 0, place))
    part = code[begin + 1:place]
    return part.count("[") > part.count("]")


def _dropped(code: str):
    for found in re.finditer(r"(?<=[\w)\]}]) [+-](?=\s)", code):
        end = _end_of_term(code, found.end() + 1)
        if end is not None and code[found.end():end].strip():
            yield (found.start(), end), "", "dropped term"
    for found in re.finditer(r"(?<=\n)[ ]+(?:\w+(?:[.\[]|->)?[\w.\[\]>-]* [+-]= [^;{}]+|(?!return\b)[a-z_]\w*(?:\.\w+)*\([^;{}]*\));(?=\n)", code):
        begin = found.start() + len(found[0]) - len(found[0].lstrip())
        if found[0].count("(") != found[0].count(")") or code[:begin].rstrip()[-1:] not in tuple(";{})"):
            continue  # the end of a statement that began before
        yield (begin, found.end() - 1), "", "dropped statement"


def _swapped(code: str):
    turn = {"x": "y", "y": "z", "z": "x", "xx": "yy", "yy": "xx", "xy": "xx"}
    for found in re.finditer(r"(?<=[\w)\]]\.)(?:xx|yy|xy|x|y|z)(?![\w(])", code):
        yield found.span(), turn[found[0]], "component"
    for found in re.finditer(r"(?<=\w\[)[01](?=\])", code):
        yield found.span(), "10"[int(found[0])], "index"
    for found in re.finditer(r"\bcross\((\w+), (\w+)\)|\b(\w+)\.cross\((\w+)\)", code):
        a, b = found[1] or found[3], found[2] or found[4]
        yield found.span(), f"cross({b}, {a})" if found[1] else f"{b}.cross({a})", "order"


def _compared(code: str):
    other = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "&&": "||", "||": "&&", "==": "!=", "!=": "=="}
    for found in re.finditer(r"(?<=[\w)\]] )(?:<=?|>=?|&&|\|\||[=!]=)(?=\s)", code):
        yield found.span(), other[found[0]], "comparison"
    for found in re.finditer(r"\b(?:std::|std::f|cwise|ranges::)?(?:min|max)(?=[({]|_element|Coeff)|\b(?:smaller|larger)(?=\()", code, re.I):
        word = found[0]
        for a, b in (("min", "max"), ("max", "min"), ("Min", "Max"), ("Max", "Min"), ("smaller", "larger"), ("larger", "smaller")):
            if word.endswith(a):
                yield found.span(), word[:-len(a)] + b, "min and max"
                break


def mutants_of(file: str, text: str) -> list[Mutant]:
    code = _code(text)
    found, lines = {}, text.splitlines()
    for finder in (_flipped, _factors, _dropped, _swapped, _compared):
        for (begin, end), new, kind in finder(code):
            line, source_begin = text.count("\n", 0, begin) + 1, text.rfind("\n", 0, begin) + 1
            source = lines[line - 1].strip()
            column = begin - source_begin - (len(lines[line - 1]) - len(lines[line - 1].lstrip()))
            copy = sum(other.strip() == source for other in lines[:line - 1])
            found.setdefault((begin, end, new), Mutant(file, begin, end, new, text[begin:end], kind, line, column, source, copy))
    return [found[key] for key in sorted(found)]


def in_turn(groups: dict, seed: int) -> list[Mutant]:
    """All mutants of areas {area: mutants} in an order that a seed fixes: from each area in turn, and within it from each kind in turn, so that any number
    of the first ones is spread over both."""
    chance = random.Random(seed)
    queues = []
    for mutants in groups.values():
        kinds = {}
        for mutant in mutants:
            kinds.setdefault(mutant.kind, []).append(mutant)
        for of_kind in kinds.values():
            chance.shuffle(of_kind)
        names = sorted(kinds)
        chance.shuffle(names)
        queues.append(_round_robin([kinds[name] for name in names]))
    return _round_robin(queues)


def _round_robin(lists: list[list]) -> list:
    return [items[k] for k in range(max(map(len, lists), default=0)) for items in lists if k < len(items)]
