"""What reading a bag ends with: the rows of a drive, before they are in the database. Workers need no more of it."""
import dataclasses
from typing import Any, Dict, List, Optional

# Of a drive: at least one strut is identified; none is; no bag, or none with what was asked for; the program was ended
# by a signal or took too long; the file was not to be had or the worker was lost, which says nothing about the bag.
OK, POOR, UNREADABLE, CRASHED, UNREAD = STATUSES = ("ok", "poor", "unreadable", "crashed", "unread")
ESTIMATOR = "estimate"  # what suspension_bag identify knows of a whole drive


@dataclasses.dataclass(frozen=True)
class Drive:
    """What a bag has said. struts, events, findings: rows of their tables, without drive_id."""
    status: str
    reason: Optional[str] = None
    start: Optional[float] = None     # [s] since 1970: the bag's first stamp
    duration: Optional[float] = None  # [s]
    diagnosed: bool = False
    struts: List[Dict[str, Any]] = dataclasses.field(default_factory=list)
    events: List[Dict[str, Any]] = dataclasses.field(default_factory=list)
    findings: List[Dict[str, Any]] = dataclasses.field(default_factory=list)
