"""What the functions take, for editors and type checkers."""
import os
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Union

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._core import StrutModel

Path = Union[str, "os.PathLike[str]"]
Array = Union["npt.ArrayLike", float]
Model = Optional[Union["StrutModel", Dict[str, Any], Path]]
Progress = Optional[Union[bool, Callable[[float], Any]]]
Option = Union[bool, int, float, str, List[str], None, Any]
