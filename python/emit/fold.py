"""Leaves out of a module what frozen constants switch off: branches, loops, functions, arguments, bindings, parameters."""
import re
from dataclasses import replace

from dialect import Statement

UNKNOWN = None
PURE_WORDS = re.compile(r"atomic_|store|set_pixel")


def number(text):
    if re.search(r"[fF.]|[eE]", text) and not text.lower().startswith("0x"):
        return float(re.sub("[fF]$", "", text))
    return int(text.rstrip("uU"), 0)


def literal(value):
    if isinstance(value, bool):
        return ("name", "true" if value else "false")
    return ("num", str(value)) if value >= 0 else ("paren", ("un", "-", ("num", str(-value))))


def walk(e):
    """All parts of an expression."""
    if e is None:
        return
    yield e
    for part in e[1:]:
        if isinstance(part, tuple):
            yield from walk(part)
        elif isinstance(part, list):
            for p in part:
                yield from walk(p)


def statements(body):
    for s in body:
        yield s
        for part in s.parts:
            if isinstance(part, list):
                yield from statements(part)
            elif part is not None:
                yield from statements([part])
        if s.kind == "for":
            yield from statements([s.more[0]])


def expressions(body):
    """All expressions of statements, with their parts."""
    for s in statements(body):
        yield from walk(s.e)
        if s.kind == "for":
            yield from walk(s.more[1])
        elif s.kind == "declare":
            for _, value in s.more[2]:
                yield from walk(value)
        elif s.kind == "array":
            yield from walk(s.more[2])


def names(body):
    return {e[1] for e in expressions(body) if e[0] == "name"}


def calls(body):
    return [e for e in expressions(body) if e[0] == "call"]


def has_effects(e):
    return any(p[0] in ("assign", "post") or p[0] == "un" and p[1] in ("++", "--") or
               p[0] == "call" and PURE_WORDS.match(p[1]) for p in walk(e))


ATOMS = ("num", "name", "call", "paren", "index", "member")
INT = {"+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": lambda a, b: a // b,
       "%": lambda a, b: a % b, "<<": lambda a, b: a << b, ">>": lambda a, b: a >> b, "&": lambda a, b: a & b,
       "|": lambda a, b: a | b, "^": lambda a, b: a ^ b}
COMPARE = {"<": lambda a, b: a < b, ">": lambda a, b: a > b, "<=": lambda a, b: a <= b, ">=": lambda a, b: a >= b,
           "==": lambda a, b: a == b, "!=": lambda a, b: a != b}


class Folder:
    """Folds one function. env: name -> (value or None, expression that takes its place or None)."""

    def __init__(self, env):
        self.env = env

    def unsigned(self, e):
        return any(p[0] == "num" and p[1][-1] in "uU" or p[0] == "call" and p[1] == "uint" for p in walk(e))

    def fold(self, e):
        """(expression, value or None)"""
        kind = e[0]
        if kind == "num":
            return e, number(e[1])
        if kind == "name":
            if e[1] in ("true", "false"):
                return e, e[1] == "true"
            value, instead = self.env.get(e[1], (None, None))
            return instead or e, value
        if kind == "paren":
            inner, value = self.fold(e[1])
            return (inner if inner[0] in ATOMS else ("paren", inner)), value
        if kind == "call":
            given = [self.fold(a)[0] for a in e[2]]
            return ("call", e[1], [a[1] if a[0] == "paren" else a for a in given]), None
        if kind == "list":
            return ("list", [self.fold(a)[0] for a in e[1]]), None
        if kind == "index":
            return ("index", self.fold(e[1])[0], self.fold(e[2])[0]), None
        if kind == "member":
            return ("member", self.fold(e[1])[0], e[2]), None
        if kind == "post":
            return ("post", e[1], self.fold(e[2])[0]), None
        if kind == "assign":
            return ("assign", e[1], self.fold(e[2])[0], self.fold(e[3])[0]), None
        if kind == "un":
            inner, value = self.fold(e[2])
            if e[1] == "!" and value is not None:
                return literal(not value), not value
            if e[1] == "-" and isinstance(value, (int, float)) and not isinstance(value, bool) and not self.unsigned(inner):
                return ("un", "-", inner), -value
            return ("un", e[1], inner), None
        if kind == "tern":
            condition, value = self.fold(e[1])
            if value is not None:
                chosen, v = self.fold(e[2] if value else e[3])
                return (chosen if chosen[0] in ATOMS else ("paren", chosen)), v
            return ("tern", condition, self.fold(e[2])[0], self.fold(e[3])[0]), None
        return self.binary(e)

    def binary(self, e):
        op, (a, va), (b, vb) = e[1], self.fold(e[2]), self.fold(e[3])
        if op in ("&&", "||"):
            ends = op == "||"  # the value that decides
            if va is not None:
                return (literal(ends), ends) if bool(va) == ends else (b, vb)
            if vb is not None and not has_effects(a):
                return (literal(ends), ends) if bool(vb) == ends else (a, None)
            return ("bin", op, a, b), None
        same = ("bin", op, a, b)
        if va is not None and vb is not None and not (self.unsigned(a) or self.unsigned(b)) or op in COMPARE and None not in (va, vb):
            if op in COMPARE:
                value = COMPARE[op](va, vb)
                return literal(value), value
            if isinstance(va, int) and isinstance(vb, int) and not (op in "/%" and (va < 0 or vb <= 0)):
                value = INT[op](va, vb)
                return (literal(value) if {a[0], b[0]} == {"num"} or value in (0, 1) and op != "-" else self.plain(op, a, va, b, vb)), value
        less = self.plain(op, a, va, b, vb)
        return less, 0 if less == ("num", "0") else None

    def plain(self, op, a, va, b, vb):
        """Without a whole number that changes nothing."""
        def is_int(e, v, what):
            return isinstance(v, int) and not isinstance(v, bool) and v == what and e[0] in ("num", "name") and \
                not (e[0] == "num" and e[1][-1] in "uU")
        if op == "*" and (is_int(a, va, 0) and not has_effects(b) or is_int(b, vb, 0) and not has_effects(a)):
            return ("num", "0")
        if op == "*" and is_int(b, vb, 1) or op in ("+", "-") and is_int(b, vb, 0):
            return a
        if op == "*" and is_int(a, va, 1) or op == "+" and is_int(a, va, 0):
            return b
        return ("bin", op, a, b)

    def block(self, body, declared):
        """The statements that are left. declared: how often the function declares each name."""
        saved, out = dict(self.env), []
        for s in body:
            new = self.statement(s, declared)
            out += new
            if new and new[-1].kind in ("return", "break", "continue"):
                break
        self.env = saved
        return out

    def inlined(self, body, declared, above):
        """A branch that is always taken, without its braces where its names are its own."""
        local = {n for s in body if s.kind in ("declare", "array") for n in
                 ([x for x, _ in s.more[2]] if s.kind == "declare" else [s.more[1]])}
        if any(declared.get(n, 0) > 1 for n in local):
            return [Statement("block", above, parts=self.block(body, declared))]
        out = []
        for s in body:  # in the env of the block around it
            out += self.statement(s, declared)
            if out and out[-1].kind in ("return", "break", "continue"):
                break
        if out and above:
            out[0] = replace(out[0], above=above + out[0].above)
        return out

    def statement(self, s, declared):
        if s.kind == "comment":
            return [s]
        if s.kind == "block":
            return [replace(s, parts=self.block(s.parts, declared))]
        if s.kind == "phases":
            return [replace(s, parts=[self.block(p, declared) for p in s.parts])]
        if s.kind == "if":
            condition, value = self.fold(s.e)
            if value is not None:
                taken = s.parts[0] if value else s.parts[1]
                return self.inlined(taken, declared, s.above) if taken else []
            yes = self.block(s.parts[0], declared)
            no = self.block(s.parts[1], declared) if s.parts[1] is not None else None
            if not yes and not no:
                return []
            if not yes:
                return [replace(s, e=("un", "!", condition if condition[0] in ATOMS else ("paren", condition)), parts=[no, None])]
            return [replace(s, e=condition, parts=[yes, no or None])]
        if s.kind == "while":
            condition, value = self.fold(s.e)
            if value is not None and not value:
                return []
            return [replace(s, e=condition, parts=[self.block(s.parts[0], declared)])]
        if s.kind == "do":
            condition, value = self.fold(s.e)
            body = self.block(s.parts[0], declared)
            once = value is not None and not value and not any(p.kind in ("break", "continue") for p in statements(body))
            return [replace(s, kind="block", parts=body)] if once else [replace(s, e=condition, parts=[body])]
        if s.kind == "for":
            return self.loop(s, declared)
        if s.kind == "declare":
            kind, const, listed = s.more
            new = []
            for name, value in listed:
                folded, known = self.fold(value) if value else (None, None)
                self.env.pop(name, None)
                if const and known is not None and kind in ("int", "bool") and not isinstance(known, float):
                    if kind == "bool":
                        self.env[name] = (bool(known), literal(bool(known)))
                        continue
                    self.env[name] = (known, literal(known) if known in (0, 1) else folded if folded[0] == "name" else None)
                new.append((name, folded))
            return [replace(s, more=(kind, const, new))] if new else []
        if s.kind == "array":
            self.env.pop(s.more[1], None)
            return [replace(s, more=(s.more[0], s.more[1], self.fold(s.more[2])[0]))]
        if s.kind in ("return", "expression") and s.e is not None:
            folded = self.fold(s.e)[0]
            while folded[0] == "paren":
                folded = folded[1]
            return [replace(s, e=folded)]
        return [s]

    def loop(self, s, declared):
        saved = dict(self.env)
        init, step = s.more
        name, first = None, None
        if init.kind == "declare":
            for name, value in init.more[2]:
                folded, first = self.fold(value) if value else (None, None)
            new_init = replace(init, more=(init.more[0], False, [(n, self.fold(v)[0] if v else None) for n, v in init.more[2]]))
            for n, _ in init.more[2]:
                self.env.pop(n, None)
        else:
            new_init = replace(init, e=self.fold(init.e)[0])
        single = init.kind == "declare" and len(init.more[2]) == 1 and isinstance(first, int)
        if single and s.e is not None:
            self.env[name] = (first, literal(first))
            if self.fold(s.e)[1] is False:
                self.env = saved
                return []
            forward = step == ("list", [("un", "++", ("name", name))])
            self.env[name] = (first + 1, None)
            changed = any(p[0] in ("assign", "un", "post") and p[1] not in ("-", "!", "~") and ("name", name) in p[2:]
                          for p in expressions(s.parts[0]))
            leaves = any(x.kind in ("break", "continue") for x in statements(s.parts[0]))
            if forward and not changed and not leaves and self.fold(s.e)[1] is False:
                self.env[name] = (first, literal(first))
                body = self.inlined(s.parts[0], declared, s.above)
                self.env = saved
                return body
            self.env.pop(name)
        out = replace(s, e=self.fold(s.e)[0] if s.e else None, more=(new_init, self.fold(step)[0]),
                      parts=[self.block(s.parts[0], declared)])
        self.env = saved
        return [out] if out.parts[0] else []


def declared_names(function):
    counts = {}
    for _, name, _ in function.parameters:
        counts[name] = counts.get(name, 0) + 1
    for s in statements(function.body):
        for name in ([n for n, _ in s.more[2]] if s.kind == "declare" else [s.more[1]] if s.kind == "array" else []):
            counts[name] = counts.get(name, 0) + 1
    return counts


def drop_unused(body, used):
    """Without variables that nothing reads."""
    out = []
    for s in body:
        if s.kind == "declare":
            kept = [(n, v) for n, v in s.more[2] if n in used or v is not None and has_effects(v)]
            if not kept:
                continue
            s = replace(s, more=(*s.more[:2], kept))
        elif s.kind == "array" and s.more[1] not in used:
            continue
        elif s.kind == "if":
            s = replace(s, parts=[drop_unused(p, used) if p is not None else None for p in s.parts])
        elif s.kind in ("for", "while", "do"):
            s = replace(s, parts=[drop_unused(s.parts[0], used)])
        elif s.kind == "block":
            s = replace(s, parts=drop_unused(s.parts, used))
        elif s.kind == "phases":
            s = replace(s, parts=[drop_unused(p, used) for p in s.parts])
        out.append(s)
    return out


def map_calls(e, change):
    if e is None or not isinstance(e, tuple):
        return e
    e = tuple(map_calls(p, change) if isinstance(p, tuple) else [map_calls(x, change) for x in p] if isinstance(p, list) else p
              for p in e)
    return change(e) if e[0] == "call" else e


def map_statements(body, change):
    out = []
    for s in body:
        s = replace(s, e=map_calls(s.e, change))
        if s.kind == "for":
            s = replace(s, more=(map_statements([s.more[0]], change)[0], map_calls(s.more[1], change)))
        elif s.kind == "declare":
            s = replace(s, more=(*s.more[:2], [(n, map_calls(v, change)) for n, v in s.more[2]]))
        if s.kind == "block":
            s = replace(s, parts=map_statements(s.parts, change))
        elif s.parts:
            s = replace(s, parts=[map_statements(p, change) if p is not None else None for p in s.parts])
        out.append(s)
    return out


def live(functions, roots):
    """The functions that the entry and `roots` call, in order."""
    by_name, wanted, todo = {f.name: f for f in functions}, set(), [f.name for f in functions if f.entry] + list(roots)
    while todo:
        name = todo.pop()
        if name in wanted or name not in by_name:
            continue
        wanted.add(name)
        todo += [c[1] for c in calls(by_name[name].body)]
    return [f for f in functions if f.name in wanted]


def specialise(source, frozen, roots):
    """`source` with constants frozen (name -> value), and nothing left that they switch off."""
    base = {name: (value, None) for name, value in frozen.items()}
    base["PIXELS"] = (1, ("num", "1"))
    for name in source.macros.table:
        tokens = source.macros.value(name)
        if tokens and name not in base:
            value = number(tokens[-1].text) * (-1 if len(tokens) == 2 else 1)
            base[name] = (value, None)
    fixed = {}  # (function, parameter) -> (value, expression)
    # Images know their extent: what a load is told of it is not read.
    images = {name for kind, _, _, name in source.bindings if "IMAGE" in kind or "SAMPLED" in kind}

    def told(call):
        where = call[2][0] if call[2] else None
        if call[1].startswith(("load_", "store_")) and where and where[0] == "name" and where[1] in images:
            return ("call", call[1], [where, ("num", "0"), *call[2][2:]])
        return call
    functions = [replace(f, body=map_statements(f.body, told)) for f in source.functions]
    for _ in range(12):
        before = repr(functions)
        functions = live(functions, roots)
        new = []
        for f in functions:
            env = dict(base)
            for _, name, _ in f.parameters:
                env.pop(name, None)
                if (f.name, name) in fixed:
                    env[name] = fixed[f.name, name]
            body = Folder(env).block(f.body, declared_names(f))
            while True:
                less = drop_unused(body, names(body))
                if repr(less) == repr(body):
                    break
                body = less
            new.append(replace(f, body=body))
        functions = live(new, roots)
        # Arguments that are the same constant in every call, or that nothing reads.
        sites = {}
        for f in functions:
            for call in calls(f.body):
                sites.setdefault(call[1], []).append([a for a in call[2] if a != ("name", "ctx")])
        gone = {}
        fixed = {}
        for f in functions:
            if f.entry or f.name in roots:
                continue
            used = names(f.body)
            for i, (_, name, _) in enumerate(f.parameters):
                given = [site[i] for site in sites.get(f.name, [])]
                if any(has_effects(g) for g in given):
                    continue
                assigned = any(p[0] in ("assign", "un", "post") and p[1] not in ("-", "!", "~") and ("name", name) in p[2:]
                               for p in expressions(f.body))
                if name not in used:
                    gone.setdefault(f.name, set()).add(i)
                elif given and all(g == given[0] for g in given) and not assigned:
                    e = given[0]
                    value = Folder(dict(base)).fold(e)[1]
                    if value is not None and e[0] in ("num", "name") and not isinstance(value, float) and \
                            (e[0] == "num" or e[1] in base or e[1] in ("true", "false")):
                        fixed[f.name, name] = (value, e)
        if gone:
            def change(call):
                if call[1] not in gone:
                    return call
                at, arguments = 0, []
                for a in call[2]:
                    if a == ("name", "ctx"):
                        arguments.append(a)
                        continue
                    if at not in gone[call[1]]:
                        arguments.append(a)
                    at += 1
                return ("call", call[1], arguments)
            functions = [replace(f, body=map_statements(f.body, change),
                                 parameters=[p for i, p in enumerate(f.parameters) if i not in gone.get(f.name, ())])
                         for f in functions]
        if repr(functions) == before and not fixed:
            break
    return functions
