"""Numbers and colours as the whole report shows them."""
import io
import math
import re

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.colors import LinearSegmentedColormap

# Okabe and Ito's palette, which colour-blind readers can tell apart.
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
SKY, PURPLE, YELLOW, BLACK = "#56B4E9", "#CC79A7", "#F0E442", "#222222"
INK, QUIET, RULE = "#222222", "#6b6b6b", "#d9d9d9"
DUST, CRUMB, PLATE = "#b9b9b9", "#8f8f8f", "#4a5560"

# For fragments: neighbours in the list differ in hue and in lightness.
FRAGMENTS = [
    "#332288", "#DDCC77", "#117733", "#CC6677", "#88CCEE", "#882255",
    "#44AA99", "#EE8866", "#0077BB", "#BBCC33", "#AA4499", "#FFAABB",
    "#666633", "#99DDFF", "#663333", "#EEDD88", "#225555", "#77AADD",
]

DAMAGE = LinearSegmentedColormap.from_list(
    "damage", ["#f4ead9", "#e8b26a", "#b4531f", "#4a1405"]
)
STRESS = "viridis"

plt.rcParams.update({
    "font.family": "DejaVu Sans",
    "font.size": 10,
    "text.color": INK,
    "axes.labelcolor": INK,
    "axes.edgecolor": "#888888",
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.titlesize": 10.5,
    "axes.titlelocation": "left",
    "grid.color": "#e8e8e8",
    "grid.linewidth": 0.8,
    "xtick.color": "#555555",
    "ytick.color": "#555555",
    "legend.frameon": False,
    "legend.fontsize": 9,
    "lines.linewidth": 1.6,
    "figure.dpi": 100,
    "savefig.dpi": 180,
    "savefig.facecolor": "white",
})

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M",
            9: "G", 12: "T"}
# Units that take a prefix on their first letter.
PREFIXED = {"N", "Pa", "J", "s", "m", "B", "W", "Hz", "Pa sqrt(m)", "N s",
            "N/m", "J/m", "J/m^2", "m/s"}


def prefix_of(largest, unit):
    """(factor, prefixed unit) that brings a value to 1 ... 1000."""
    if unit not in PREFIXED or not largest or not math.isfinite(largest):
        return 1.0, unit
    power = 3 * math.floor(math.log10(abs(largest)) / 3 + 1e-9)
    power = min(max(power, -12), 12)
    if unit in ("s", "m", "m/s") and power > 0:
        power = 0  # nobody reads kiloseconds
    return 10.0 ** -power, PREFIXES[power] + unit


def pretty_unit(unit):
    """A unit for people: m^2 as m², 1/sqrt(mm) with its root sign."""
    for power, sign in (("^2", "²"), ("^3", "³"), ("^4", "⁴")):
        unit = unit.replace(power, sign)
    unit = re.sub(r"sqrt\((\w+)\)", r"√\1", unit)
    unit = re.sub(r"\bu(?=[mNPJsg])", "µ", unit)
    return "" if unit == "1" else unit


def ten_to(power):
    """A power of ten, 10⁻³."""
    return "10" + str(power).translate(
        str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def digits(value, significant=4):
    """A number with so many digits, integers whole, in groups of three."""
    if value == 0:
        return "0"
    if float(value).is_integer() and abs(value) < 1e15:
        return f"{int(value):,}".replace(",", "\u202f")
    magnitude = math.floor(math.log10(abs(value)))
    if magnitude >= significant:
        return f"{value:,.0f}".replace(",", "\u202f")
    if magnitude < -3:
        mantissa = f"{value:.{significant - 1}e}".split("e")
        return f"{mantissa[0]} · {ten_to(int(mantissa[1]))}".replace("-", "−")
    return f"{value:.{significant - 1 - magnitude}f}".replace("-", "−")


def percent(share, significant=3):
    """A share as a percentage."""
    value = 100.0 * share
    if value == 0 or abs(value) >= 0.01:
        places = 1 if abs(value) >= 10 else 2
        return f"{value:.{places}f}\u202f%".replace("-", "−")
    return digits(value, significant) + "\u202f%"


def quantity(value, unit, significant=4):
    """A value in a fitting prefix, with its unit."""
    factor, prefixed = prefix_of(value, unit)
    name = pretty_unit(prefixed)
    number = digits(value * factor, significant)
    return number + ("\u202f" + name if name else "")


def duration(seconds):
    """A time for people: 3.20 s, 4 min 10 s, 2 h 5 min."""
    if seconds < 60:
        return quantity(seconds, "s", 3)
    minutes, rest = divmod(round(seconds), 60)
    if minutes < 60:
        return f"{minutes}\u202fmin {rest}\u202fs"
    return f"{minutes // 60}\u202fh {minutes % 60}\u202fmin"


def is_share(name, unit):
    """Whether a dimensionless result reads better in percent."""
    return unit == "1" and (
        name.endswith(("_share", "_error", "_strain", "strain_at_peak"))
        or "_error_" in name or "_over_strain_" in name)


def plain(value):
    """A number as publications state it: without closing zeros."""
    text = digits(value, 6)
    return text.rstrip("0").rstrip(".") if (
        "." in text and "·" not in text) else text


def measured(value, deviation=None):
    """"12.34 ± 0.56": a number, and how it scatters."""
    if not deviation:
        return digits(value)
    if not (1e-3 <= deviation and abs(value) < 1e6):
        return f"{digits(value)} ± {digits(deviation, 2)}"
    places = max(0, 1 - math.floor(math.log10(deviation)))
    return f"{value:.{places}f} ± {deviation:.{places}f}".replace("-", "−")


def shift(value):
    """A difference with its sign."""
    return f"{value:+.2f}".replace("-", "−")


def difference(share):
    """A relative difference with its sign; a factor where it is large."""
    if share >= 9:
        return f"{digits(1 + share, 3)} times"
    sign = "+" if share > 0 else "−" if share < 0 else ""
    return sign + percent(abs(share))


def legend_above(figure, handles, labels, columns):
    """A legend above the axes in at most so many columns, fewer where the
    labels are long; the figure grows by its rows."""
    widest = 0.075 * max(map(len, labels)) + 0.5  # inches, about
    columns = max(1, min(columns, int(figure.get_figwidth() / widest)))
    height = figure.get_figheight()
    whole = height + 0.1 + 0.23 * math.ceil(len(labels) / columns)
    figure.set_figheight(whole)
    figure.get_layout_engine().set(rect=(0, 0, 1, height / whole))
    figure.legend(handles, labels, loc="upper center", ncol=columns)


# What reading entries that are missing, or not what they should be, raises.
BROKEN = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)


def problem_of(error):
    """What went wrong, for a note."""
    if isinstance(error, KeyError):
        return f"{error} is missing"
    return str(error) or type(error).__name__


def picture(make, *arguments):
    """(PNG, None) of the figure that make(*arguments) draws, (None, None) if
    there is nothing to draw, (None, what went wrong) if it cannot."""
    try:
        figure = make(*arguments)
    except BROKEN as error:
        plt.close("all")
        return None, problem_of(error)
    if figure is None:
        return None, None
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    plt.close(figure)
    return buffer.getvalue(), None
