"""What is said of a strut's prognosis, in words."""
import datetime
import math

NO_DRIVES = "no drive whose estimates are valid"


def plain(text):
    """With an escape instead of what is not to be seen: names are the user's, and a terminal obeys some characters."""
    return "".join(each if each.isprintable() else ascii(each)[1:-1] for each in text)


def day(time):
    """Such as 4 March 2027, UTC."""
    date = datetime.datetime.fromtimestamp(time, datetime.timezone.utc)
    return f"{date.day} {date:%B %Y}"


def is_date(time):
    """Whether a calendar has it."""
    try:
        return bool(day(time))
    except (TypeError, ValueError, OverflowError, OSError):
        return False


def days(early, late):
    """Such as 4 March and 2 May 2027: the year once if it is the same."""
    first, second = day(early), day(late)
    return f"{first[:-5] if first[-5:] == second[-5:] else first} and {second}"


def _can_be_said(time):
    """Whether a calendar has it; a date in thousands of years is as good as none."""
    return time < datetime.datetime(9000, 1, 1, tzinfo=datetime.timezone.utc).timestamp()


def percent(share):
    """Signed, with a decimal below 10 %; U+2212 for minus is not for every terminal."""
    number = 100 * share
    return f"{number:+.1f} %" if abs(number) < 9.95 else f"{number:+.0f} %"


def span(wear):
    """What the part has changed by since it was new, from .. to."""
    low, _, high = wear.loss
    decimals = 0 if high - low > 0.02 else 1
    ends = (f"{-100 * share:+.{decimals}f}" for share in (high, low))
    return " .. ".join("0" if float(end) == 0 else end for end in ends) + " %"


def rate(wear):
    """2.1 ± 0.4 % a month, to the first digit that is known."""
    decimals = max(0, min(3, -math.floor(math.log10(max(100 * wear.rate_stddev, 1e-3)))))
    return f"{100 * wear.rate:.{decimals}f} ± {100 * wear.rate_stddev:.{decimals}f} % a month"


def of_strut(history, prognosis):
    """The outlook, and what is left out."""
    said, count = outlook(prognosis) if prognosis else NO_DRIVES, history.wrong_clocks
    return f"{said}; {count} drive{'s have' if count > 1 else ' has'} a wrong clock" if count else said


def outlook(prognosis):
    """The sentence about the part whose date is known, or why there is none."""
    threshold = f"-{100 * prognosis.options.threshold:g} %"
    if prognosis.dated:
        wear = prognosis.wear[prognosis.dated]
        early, _, late = wear.date
        reaches = "has reached" if late <= prognosis.last else "reaches"
        when = f"between {days(early, late)}" if _can_be_said(late) else f"not before {day(early)}"
        return f"{prognosis.dated} falls {rate(wear)}, {reaches} {threshold} {when}"
    if prognosis.reached:
        return f"{' and '.join(prognosis.reached)} has reached {threshold}"
    if prognosis.likely_change:
        return f"probably changed on {day(prognosis.likely_change)} or before: more drives will tell"
    reason = ("the spring wears, or damping grows: stiffness/mass does not tell" if prognosis.stiffer_or_softer else
              "a season may be all of the trend" if prognosis.season_or_wear else "no trend that is certain")
    early = prognosis.wear["damping"].date[0]
    if early <= prognosis.last:
        return f"{reason}; whether damping has reached {threshold} cannot be told"
    return f"{reason}; damping reaches {threshold} not before {day(early)}" if _can_be_said(early) else reason


def remarks(prognosis):
    """What else is to be known of it, a sentence each."""
    said = [change(each) for each in prognosis.changes]
    if prognosis.both_fall:
        said.append("damping and stiffness per mass probably both fall: a payload that grows, or both parts wear; "
                    "one strut alone cannot tell")
    return said


def change(point):
    """A step of log(b1/b0), in terms of the part that it is of."""
    between = f"between {days(point.before, point.time)}"
    damping = f"damping {percent(math.expm1(point.step))}"
    stiffness = f"stiffness {percent(math.expm1(-point.step))}"
    size = {"damping": damping, "stiffness": stiffness, None: f"{damping} or {stiffness}"}[point.part]
    if abs(point.step) < 2 * point.step_stddev:
        return f"another trend {between}"
    return f"{size} at once, {between}"


def effect(span):
    first, last = day(span.first), day(span.last)
    if span.present:
        return f"{span.name} since {first}"
    return f"{span.name} from {first} to {last}" if first != last else f"{span.name} on {first}"
