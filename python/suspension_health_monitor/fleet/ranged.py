"""Options with a default, a range and a meaning: fields of a dataclass, arguments of a command."""
import dataclasses

from .errors import UsageError


def option(default, low, high, meaning):
    return dataclasses.field(default=default, metadata={"range": (low, high), "meaning": meaning})


@dataclasses.dataclass(frozen=True)
class Ranged:
    """:raises UsageError: a value that is not allowed."""

    def __post_init__(self):
        for field in dataclasses.fields(self):
            value, (low, high) = getattr(self, field.name), field.metadata["range"]
            if not low <= value <= high:
                raise UsageError(f"--{_argument(field)} {value:g}, must lie in [{low:g}, {high:g}]: "
                                 f"{field.metadata['meaning']}")

    @classmethod
    def add_to(cls, command, leave_out=()):
        for field in dataclasses.fields(cls):
            if field.name in leave_out:
                continue
            low, high = field.metadata["range"]
            command.add_argument("--" + _argument(field), type=field.type, default=field.default, metavar="X",
                                 help=f"{field.metadata['meaning']} [{low:g}, {high:g}]; default: %(default)g")

    @classmethod
    def of(cls, options):
        """Of what the command line has said."""
        return cls(**{field.name: getattr(options, field.name) for field in dataclasses.fields(cls)})


def _argument(field):
    return field.name.replace("_", "-")
