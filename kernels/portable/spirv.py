"""The NoContraction decoration on every floating-point result of a SPIR-V module."""

# SPIR-V: instructions whose result must not be contracted (SPIR-V specification 1.6, NoContraction).
ARITHMETIC = {127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148}
OP_DECORATE, OP_MEMBER_DECORATE, NO_CONTRACTION = 71, 72, 42
# Instructions of a module's layout that come before the decorations.
BEFORE_DECORATIONS = {17, 10, 11, 14, 15, 16, 331, 3, 2, 4, 7, 5, 6, 330, OP_DECORATE, OP_MEMBER_DECORATE, 73, 74, 75, 332}


def forbid_contraction(words):
    """Decorates every floating-point result with NoContraction."""
    ids, at, insert = [], 5, None
    while at < len(words):
        opcode, count = words[at] & 0xffff, words[at] >> 16
        if insert is None and opcode not in BEFORE_DECORATIONS:
            insert = at
        if opcode in ARITHMETIC:
            ids.append(words[at + 2])
        at += count
    extra = [word for i in ids for word in ((3 << 16) | OP_DECORATE, i, NO_CONTRACTION)]
    return words[:insert] + extra + words[insert:]
