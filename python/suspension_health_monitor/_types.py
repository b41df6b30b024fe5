"""What the functions take, for editors and type checkers."""
import datetime
import os
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Sequence, Union

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._core import StrutModel

Path = Union[str, "os.PathLike[str]"]
Array = Union["npt.ArrayLike", float, datetime.datetime, Sequence[datetime.datetime]]
Model = Optional[Union["StrutModel", Dict[str, Any], Path]]
Progress = Optional[Union[bool, Callable[[float], Any]]]
Option = Union[bool, int, float, str, List[str], None, Any]
