"""Fields of parameters: set by name, with names for values of enums, and errors that say what there is."""
import difflib
import enum


def names_of(value):
    """Names of the fields of parameters."""
    return [name for name, kind in vars(type(value)).items() if isinstance(kind, property) or type(kind).__name__ == "nb_property"
            or hasattr(kind, "fset")]


def set_field(parameters, name, value):
    """Sets one field. A string stands for the value of an enum. AttributeError: no such field; ValueError, TypeError: not its value."""
    kind = type(parameters).__name__
    if name not in names_of(parameters):
        near = difflib.get_close_matches(name, names_of(parameters), 1)
        raise AttributeError(f"{kind} has no field {name}" + (f"; did you mean {near[0]}?" if near else
                                                               f"; expected one of {', '.join(names_of(parameters))}"))
    now = getattr(parameters, name)
    if isinstance(now, enum.Enum) and isinstance(value, str):
        if value not in type(now).__members__:
            raise ValueError(f"{kind}.{name} is {value!r}; expected one of {', '.join(type(now).__members__)}")
        value = type(now)[value]
    if isinstance(now, int) and not isinstance(now, bool) and isinstance(value, float) and value.is_integer():
        value = int(value)
    try:
        object.__setattr__(parameters, name, value)
    except TypeError:
        raise TypeError(f"{kind}.{name} is {value!r} ({type(value).__name__}); expected {type(now).__name__}, like {now!r}") from None


def text(parameters):
    """GaussianBlurParams(width=64, ...), every field."""
    def shown(value):
        return value.name if isinstance(value, enum.Enum) else repr(value)
    return f"{type(parameters).__name__}({', '.join(f'{name}={shown(getattr(parameters, name))}' for name in names_of(parameters))})"
