"""The NoContraction decoration on every floating-point result (SPIR-V specification 1.6), as luxel's own modules have it."""

ARITHMETIC = {127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148}
OP_DECORATE, NO_CONTRACTION = 71, 42
BEFORE_DECORATIONS = {17, 10, 11, 14, 15, 16, 331, 3, 2, 4, 7, 5, 6, 330, OP_DECORATE, 72, 73, 74, 75, 332}


def forbid_contraction(words):
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
