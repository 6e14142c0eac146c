"""How numbers of a plan follow from the size: tried formulas, kept where they hold at every size."""
import itertools


def rule_of(sizes, values):
    """A formula as text that gives `values` at `sizes` (name -> number), the first that does; None where none is found."""
    first = values[0]
    if all(v == first for v in values):
        return str(int(first) if float(first).is_integer() else first) if len(sizes) > 1 or not sizes[0] else None
    if len(sizes) < 3:
        return None
    names = list(sizes[0])
    for count in range(1, len(names) + 1):
        for some in itertools.combinations(names, count):
            products = [1] * len(sizes)
            for name in some:
                products = [p * s[name] for p, s in zip(products, sizes)]
            factor = first / products[0]
            if float(factor).is_integer() and factor and all(v == factor * p for v, p in zip(values, products)):
                return " * ".join(([str(int(factor))] if factor != 1 else []) + list(some))
    for name in names:
        for n in range(2, 4097):
            if all(v == -(-s[name] // n) for v, s in zip(values, sizes)):
                return f"ceil({name} / {n})"
    for name in names:
        if all(abs(v * s[name] - 1) < 1e-12 for v, s in zip(values, sizes)):
            return f"1 / {name}"
    product = [1] * len(sizes)
    for name in names:
        product = [p * s[name] for p, s in zip(product, sizes)]
    for n in range(2, 4097):
        if all(v == -(-p // n) for v, p in zip(values, product)):
            return f"ceil({' * '.join(names)} / {n})"
    return None
