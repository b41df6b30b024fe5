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
    """The outlook, what is left out, and which names the vehicle has had."""
    said, count = [outlook(prognosis) if prognosis else NO_DRIVES], history.wrong_clocks
    if count:
        said.append(f"{count} drive{'s have' if count > 1 else ' has'} a wrong clock")
    said += [f"the vehicle was called {name} until {day(until)}" for name, until in history.formerly]
    if history.perhaps:
        new, names = history.vehicle, " or ".join(history.perhaps)
        said.append(f"perhaps the vehicle was called {names}: --renamed {new}={history.perhaps[0]} says that it was, "
                    f"--renamed {new}= that it is another one")
    return "; ".join(said)


def outlook(prognosis):
    """The sentence about the part whose date is known, or why there is none. No date in it is before the last drive."""
    threshold = f"-{100 * prognosis.options.threshold:g} %"
    if prognosis.dated:
        wear = prognosis.wear[prognosis.dated]
        return f"{prognosis.dated} falls {rate(wear)}, {_when(wear.date, prognosis.last, threshold)}"
    if prognosis.reached:
        return f"{' and '.join(prognosis.reached)} has reached {threshold}"
    if prognosis.likely_change:
        return f"probably changed on {day(prognosis.likely_change)} or before: more drives will tell"
    damping = prognosis.wear["damping"]
    reason = why_no_date(damping.probability)
    if damping.loss[2] >= prognosis.options.threshold:
        return f"{reason}; whether damping has reached {threshold} cannot be told"
    early = max(damping.date[0], prognosis.last)
    return f"{reason}; damping reaches {threshold} not before {day(early)}" if _can_be_said(early) else reason


def _when(date, last, threshold):
    early, _, late = date
    if late <= last:
        return f"has reached {threshold}"
    if not _can_be_said(late):
        return f"reaches {threshold} not before {day(max(early, last))}"
    if early <= last:
        return f"has reached {threshold} by now or will by {day(late)}"
    return f"reaches {threshold} between {days(early, late)}"


def why_no_date(probability):
    """What the drives bear out instead of wear that goes on, or beside it."""
    if probability["falls"] <= 0.5:
        return "has changed, but may have settled" if probability["settles"] > 0.5 else "no trend that is certain"
    rival = "may settle" if probability["settles"] > probability["stays"] else "a season, loads or chance may be all of it"
    return f"probably falls, but {rival}"


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
