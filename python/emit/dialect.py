"""The dialect as a tree: the text of one module, its macros expanded, its functions parsed.

Expressions are tuples: (num, text) (name, text) (call, name, args) (un, op, e) (post, op, e) (bin, op, a, b) (tern, c, a, b)
(paren, e) (index, e, i) (member, e, name) (assign, op, a, b). Statements are Statement objects.
"""
import re
from dataclasses import dataclass, field

TOKEN = re.compile(r"""(?P<line>\n)|(?P<space>[ \t]+|\\\n)|(?P<comment>//[^\n]*|/\*.*?\*/)
  |(?P<num>(?:0[xX][0-9a-fA-F]+|(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?)[uUfF]*)|(?P<name>\w+)
  |(?P<op><<=|>>=|\+\+|--|&&|\|\||[=!<>]=|<<|>>|[-+*/%&|^]=|[-+*/%&|^~!<>=?:;,.(){}\[\]])""", re.VERBOSE | re.DOTALL)


@dataclass
class Token:
    kind: str
    text: str
    above: list = field(default_factory=list)  # comments on lines of their own before it
    beside: str = ""                           # a comment after it on its line


def tokenize(text):
    tokens, above, fresh, at, lines = [], [], True, 0, 0
    while at < len(text):
        match = TOKEN.match(text, at)
        if not match:
            raise SyntaxError(f"no word of the dialect: {text[at:at + 40]!r}")
        at, kind, word = match.end(), match.lastgroup, match.group()
        if kind == "line":
            fresh, lines = True, lines + 1
            if lines == 2 and above:
                above.append("")  # a blank line between comments
        elif kind == "comment":
            lines = 0
            if fresh or not tokens:
                above.append(word)
            else:
                tokens[-1].beside = word
        elif kind != "space":
            tokens.append(Token(kind, word, above))
            above, fresh, lines = [], False, 0
    return tokens


class Macros:
    """What #define says, and what of a text its #if leave over."""

    def __init__(self):
        self.table = {}  # name -> (parameters or None, tokens, comment)

    def define(self, name, parameters, body, comment=""):
        self.table[name] = (parameters, [Token(t.kind, t.text) for t in tokenize(body)], comment)

    def preprocess(self, text):
        """The active lines of a text, without its directives."""
        kept, states = [], []  # states: (this branch is active, some branch was)
        pending = []           # comments that may belong to a #define
        for line in re.sub(r"\\\n", " \x00", text).split("\n"):
            active = all(state[0] for state in states)
            directive = re.match(r"\s*#\s*(\w+)\s*(.*)", line.replace("\x00", " "))
            if not directive:
                if active:
                    kept.append(line.replace("\x00", ""))
                continue
            word, rest = directive.groups()
            if word in ("if", "ifdef", "ifndef"):
                condition = {"if": rest, "ifdef": f"defined({rest})", "ifndef": f"!defined({rest})"}[word]
                holds = bool(active and self.holds(condition))
                states.append((holds, holds))
            elif word == "elif":
                holds = not states[-1][1] and bool(all(s[0] for s in states[:-1]) and self.holds(rest))
                states[-1] = (holds, states[-1][1] or holds)
            elif word == "else":
                states[-1] = (not states[-1][1], True)
            elif word == "endif":
                states.pop()
            elif word == "define" and active:
                comment = "".join(re.findall(r"//.*|/\*.*?\*/", rest)[-1:]) if not re.match(r"\w+\(", rest) else ""
                rest = re.sub(r"//.*|/\*.*?\*/", "", rest).strip()
                name, parameters, body = re.match(r"(\w+)(\([^)]*\))?(.*)", rest, re.DOTALL).groups()
                listed = parameters and [p.strip() for p in parameters[1:-1].split(",")]
                self.define(name, listed, body.strip(), comment)
            elif word == "undef" and active:
                self.table.pop(rest.split()[0], None)
        return "\n".join(kept)

    def holds(self, condition):
        condition = re.sub(r"//.*|/\*.*?\*/", "", condition)
        condition = re.sub(r"defined\s*\(?\s*(\w+)\s*\)?", lambda m: str(int(m[1] in self.table)), condition)
        words = " ".join(t.text if t.kind != "name" else "0" for t in self.expand(tokenize(condition), True))
        words = words.replace("&&", " and ").replace("||", " or ")
        return eval(re.sub(r"!(?!=)", " not ", words), {"__builtins__": {}})  # numbers and operators alone are left

    def value(self, name):
        """The tokens of a macro that is a named number, else None."""
        parameters, body, _ = self.table.get(name, ([], [], ""))
        if parameters is not None:
            return None
        bare = [t for t in body if t.text not in "()"]
        number = len(bare) == 1 and bare[0].kind == "num" or \
            len(bare) == 2 and bare[0].text == "-" and bare[1].kind == "num"
        return bare if number else None

    def expand(self, tokens, numbers=False, busy=frozenset()):
        """Macros replaced by what they stand for; named numbers only where asked."""
        out, at = [], 0
        while at < len(tokens):
            token = tokens[at]
            at += 1
            known = token.kind == "name" and token.text not in busy and self.table.get(token.text)
            if not known or (not numbers and self.value(token.text)):
                out.append(token)
                continue
            parameters, body, _ = known
            if parameters is None:
                new = self.expand(body, numbers, busy | {token.text})
            else:
                if at >= len(tokens) or tokens[at].text != "(":
                    out.append(token)
                    continue
                arguments, depth = [[]], 1
                at += 1
                while depth:
                    t = tokens[at]
                    at += 1
                    depth += {"(": 1, ")": -1}.get(t.text, 0)
                    if depth == 1 and t.text == ",":
                        arguments.append([])
                    elif depth:
                        arguments[-1].append(t)
                given = dict(zip(parameters, (self.expand(a, numbers, busy) for a in arguments)))
                body = [x for t in body for x in (given[t.text] if t.text in given else [t])]
                new = self.expand(body, numbers, busy | {token.text})
            new = [Token(t.kind, t.text) for t in new]
            if new:
                new[0].above, new[-1].beside = token.above, token.beside
            out += new
        return out


@dataclass
class Statement:
    kind: str              # block if for while return break continue declare array phases expression
    above: list = field(default_factory=list)
    beside: str = ""
    parts: list = field(default_factory=list)  # statements in it
    e: tuple = None        # condition, value, expression
    more: tuple = ()       # for: (init statement, step expression); declare: (type, const, [(name, value)]); array: (type, name, count)
    unroll: bool = False


@dataclass
class Function:
    name: str
    type: str
    ctx: bool
    parameters: list       # (type, name, const)
    body: list
    above: list
    entry: bool = False


BINARY = {"*": 10, "/": 10, "%": 10, "+": 9, "-": 9, "<<": 8, ">>": 8, "<": 7, ">": 7, "<=": 7, ">=": 7, "==": 6, "!=": 6,
          "&": 5, "^": 4, "|": 3, "&&": 2, "||": 1}
ASSIGN = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}


class Parser:
    def __init__(self, tokens):
        self.tokens, self.at = tokens, 0

    def peek(self, ahead=0):
        return self.tokens[self.at + ahead].text if self.at + ahead < len(self.tokens) else ""

    def take(self, text=None):
        token = self.tokens[self.at]
        if text is not None and token.text != text:
            near = " ".join(t.text for t in self.tokens[max(0, self.at - 8):self.at + 8])
            raise SyntaxError(f"expected {text} in: {near}")
        self.at += 1
        return token

    def functions(self):
        found = []
        while self.at < len(self.tokens):
            above = self.tokens[self.at].above
            if self.peek() == "KERNEL":
                self.take()
                self.take("(")
                name = self.take().text
                self.take(")")
                function = Function(name, "void", True, [], [], above, True)
            else:
                self.take("FN")
                kind, name = self.take().text, self.take().text
                function = Function(name, kind, False, [], [], above)
                self.take("(")
                while self.peek() != ")":
                    if self.peek() == ",":
                        self.take()
                    elif self.peek() == "CTX":
                        self.take()
                        function.ctx = True
                    else:
                        const = self.peek() == "const" and bool(self.take())
                        kind, own = self.take().text, self.take().text
                        if self.peek() == "[":
                            self.take()
                            kind += f"[{self.take().text}]"
                            self.take("]")
                        function.parameters.append((kind, own, const))
                self.take(")")
            self.take("{")
            function.body = self.statements()
            found.append(function)
        return found

    def statements(self):
        found = []
        while self.peek() != "}":
            statement = self.statement()
            if statement:
                found.append(statement)
        last = self.take("}")
        if last.above:
            found.append(Statement("comment", last.above))
        return found

    def one(self):
        """The statements of a branch or a loop."""
        if self.peek() == "{":
            self.take()
            return self.statements()
        statement = self.statement()
        return [statement] if statement else []

    def ended(self, statement):
        statement.beside = self.take(";").beside
        return statement

    def declaration(self):
        const = self.peek() == "const" and bool(self.take())
        kind, listed = self.take().text, []
        while True:
            name = self.take().text
            listed.append((name, self.expression() if self.peek() == "=" and self.take() else None))
            if self.peek() != ",":
                return Statement("declare", more=(kind, const, listed))
            self.take()

    def is_declaration(self):
        return self.peek() == "const" or self.tokens[self.at].kind == "name" and self.tokens[self.at + 1].kind == "name"

    def statement(self):
        above, word = self.tokens[self.at].above, self.peek()
        statement = self.plain(word)
        if statement:
            statement.above = above
        return statement

    def plain(self, word):
        if word == ";":
            self.take()
            return None
        if word == "{":
            self.take()
            return Statement("block", parts=self.statements())
        if word == "if":
            self.take()
            self.take("(")
            condition = self.expression()
            beside = self.take(")").beside
            if self.peek() == "{" and self.tokens[self.at].beside:
                beside = self.tokens[self.at].beside
            yes = self.one()
            no = None
            if self.peek() == "else":
                self.take()
                no = self.one()
            return Statement("if", e=condition, parts=[yes, no], beside=beside)
        if word == "UNROLL":
            self.take()
            loop = self.plain(self.peek())
            loop.unroll = True
            return loop
        if word == "for":
            self.take()
            self.take("(")
            init = self.declaration() if self.is_declaration() else Statement("expression", e=self.comma(";"))
            self.take(";")
            condition = None if self.peek() == ";" else self.expression()
            self.take(";")
            step = self.comma(")")
            self.take(")")
            return Statement("for", e=condition, more=(init, step), parts=[self.one()])
        if word == "while":
            self.take()
            self.take("(")
            condition = self.expression()
            self.take(")")
            return Statement("while", e=condition, parts=[self.one()])
        if word == "do":
            self.take()
            body = self.one()
            self.take("while")
            self.take("(")
            condition = self.expression()
            self.take(")")
            return self.ended(Statement("do", e=condition, parts=[body]))
        if word == "return":
            self.take()
            return self.ended(Statement("return", e=None if self.peek() == ";" else self.expression()))
        if word in ("break", "continue"):
            self.take()
            return self.ended(Statement(word))
        if word == "ARRAY":
            self.take()
            self.take("(")
            kind = self.take().text
            self.take(",")
            name = self.take().text
            self.take(",")
            count = self.expression()
            return Statement("array", beside=self.take(")").beside, more=(kind, name, count))
        if word == "FIRST":
            phases = []
            while self.peek() in ("FIRST", "THEN"):
                self.take()
                self.take("{")
                phases.append(self.statements())
            return Statement("phases", parts=phases)
        if self.is_declaration():
            if self.peek() != "const" and self.peek(2) == "[":
                kind, name = self.take().text, self.take().text
                self.take("[")
                count = self.expression()
                self.take("]")
                return self.ended(Statement("array", more=(kind, name, count)))
            return self.ended(self.declaration())
        return self.ended(Statement("expression", e=self.expression()))

    def comma(self, end):
        listed = []
        while self.peek() != end:
            listed.append(self.expression())
            if self.peek() == ",":
                self.take()
        return ("list", listed)

    def expression(self):
        left = self.ternary()
        if self.peek() in ASSIGN:
            return ("assign", self.take().text, left, self.expression())
        return left

    def ternary(self):
        condition = self.binary(1)
        if self.peek() != "?":
            return condition
        self.take()
        yes = self.expression()
        self.take(":")
        return ("tern", condition, yes, self.ternary())

    def binary(self, least):
        left = self.unary()
        while BINARY.get(self.peek(), 0) >= least:
            op = self.take().text
            left = ("bin", op, left, self.binary(BINARY[op] + 1))
        return left

    def unary(self):
        if self.peek() in ("-", "!", "~", "++", "--", "+"):
            return ("un", self.take().text, self.unary())
        token = self.take()
        if token.text == "(":
            e = ("paren", self.expression())
            self.take(")")
        elif token.kind == "num":
            e = ("num", token.text)
        elif token.kind != "name":
            raise SyntaxError(f"unexpected {token.text}")
        elif self.peek() == "(":
            self.take()
            arguments = self.comma(")")[1]
            self.take(")")
            e = ("call", token.text, arguments)
        else:
            e = ("name", token.text)
        while True:
            if self.peek() == "[":
                self.take()
                e = ("index", e, self.expression())
                self.take("]")
            elif self.peek() == ".":
                self.take()
                e = ("member", e, self.take().text)
            elif self.peek() in ("++", "--"):
                e = ("post", self.take().text, e)
            else:
                return e


def split_module(glsl):
    """(options, packing, math and signature, kernel) of a module's flat text; all but the header is the dialect itself."""
    options = re.findall(r"^#define (\w+) (\S+)$", glsl[:glsl.index("// The dialect in GLSL")], re.MULTILINE)
    begin = glsl.index("// Storage formats in integers")
    packing = glsl[begin:glsl.index("vec4 f16x4_value(uvec2 u)")]
    last = "#define atomic_compare_swap(b, i, expected, v) atomicCompSwap(b[i], expected, v)\n"
    rest = glsl[glsl.index(last) + len(last):]
    given = rest[:rest.index("layout(push_constant) uniform Parameters")]
    kernel = rest[rest.index("BINDINGS(GLSL_BINDING)\n") + len("BINDINGS(GLSL_BINDING)\n"):]
    return dict(options), packing, given, kernel


@dataclass
class Source:
    """One module: what it is given, and its functions."""
    options: dict
    macros: Macros
    functions: list
    bindings: list     # (kind, slot, type or count, name)
    parameters: list   # (type, name, remark)
    constants: list    # (id, type, name, default, remark, shape)
    shared: list       # (type, count, name)
    about: list        # the kernel's first comment


def entries(macros, name, remarks):
    """The lines of a list of the signature."""
    if name not in macros.table:
        return []
    tokens = macros.expand(tokenize(f"{name}(LINE)"), True, frozenset({"LINE"}))
    found, at = [], 0
    while at < len(tokens):
        at += 2  # LINE (
        words, depth = [""], 1
        while depth:
            text = tokens[at].text
            at += 1
            depth += {"(": 1, ")": -1}.get(text, 0)
            if depth == 1 and text == ",":
                words.append("")
            elif depth:
                words[-1] += text
        found.append([*words, remarks.get((words[-1] if name != "CONSTANTS" and name != "SHAPE" else words[2]), "")])
    return found


def parse_module(glsl):
    options, packing, given, kernel = split_module(glsl)
    macros = Macros()
    macros.define("CHANNELS", None, options.get("CHANNELS", "4"))
    for name, value in options.items():
        macros.define(name, None, value)
    for name, value in (("LANES", "CHANNELS"), ("PIXELS", "1")):
        macros.define(name, None, value)
    channels = int(options.get("CHANNELS", "4"))
    for name in ("wide", "pixel"):
        macros.define(name, None, "float" if channels == 1 else f"vec{channels}")
    # `_(int, width) /* pixels */`: what a line's comment says of its name
    remarks = {}
    for arguments, remark in re.findall(r"_\(([^()]*(?:\([^()]*\)[^()]*)*)\)\s*/\*\s*(.*?)\s*\*/", given):
        words = [w.strip() for w in arguments.split(",")]
        remarks[words[2] if len(words) == 4 and words[0].isdigit() else words[-1]] = remark
    given = macros.preprocess(given)
    kernel = macros.preprocess(kernel)
    math_functions = re.sub(r"^\s*/\* BUILD.*?\*/", "", given, flags=re.DOTALL)
    for name in ("PARAMETERS", "CONSTANTS", "SHAPE", "BINDINGS", "SHARED_MEMORY"):
        macros.table.setdefault(name, (["_"], [], ""))
    source = Source(options, macros, [], [], [], [], [], [])
    source.bindings = [(k, int(s), t, n) for k, s, t, n, _ in entries(macros, "BINDINGS", remarks)]
    source.parameters = [tuple(line) for line in entries(macros, "PARAMETERS", remarks)]
    source.constants = [(int(i), t, n, v, r, False) for i, t, n, v, r in entries(macros, "CONSTANTS", remarks)] + \
        [(int(i), t, n, v, r, True) for i, t, n, v, r in entries(macros, "SHAPE", remarks)]
    source.shared = [(t, c, n) for t, c, n, _ in entries(macros, "SHARED_MEMORY", remarks)]
    # A constant of the signature is no macro, whatever a header says of its name.
    for _, _, name, _, _, _ in source.constants:
        if name == "LANES":
            continue
        macros.table.pop(name, None)
    for text in (packing, math_functions, kernel):
        tokens = macros.expand(tokenize(text))
        if text is kernel:
            raw = tokenize(text)
            above = raw[0].above if raw else []
            if "" in above or text.lstrip().startswith("//"):
                cut = above.index("") if "" in above else 0
                source.about = above[:cut]
                tokens[0].above = above[cut + 1:] if cut else above
        source.functions += Parser(tokens).functions()
    return source
