"""A beam that tells its strength, and what the page's Set-up shows and sounds of it."""

from page_bench import with_page

from alignment import FAR_MM, contrast, jog, view as aligned, with_contrast  # noqa: E402, F401  page_bench has set the path to it

AWAY_MRAD = 6.0
SIGNAL = "document.querySelector('#setup_beam .signal')"
STRUCK_STRENGTH = "getComputedStyle(document.querySelector('#setup_beam .strength .number')).textDecorationLine"
# Remembers every source of sound that the page makes.
WATCH_AUDIO = """
    window.heard = [];
    window.AudioContext = class extends window.AudioContext {
        constructor(...words) {
            super(...words);
            window.heard.push(this);
        }
    };
"""


def at_far_end(b):
    """A beam that lies along the motion, and the reflector far away, where an angle is felt most."""
    with_contrast(b, 0.0)
    address = with_page(b)
    b.start()
    jog(b, FAR_MM)
    return address


def steered_away(b):
    """Gives back the percent that are left."""
    b.sim(f"steer {AWAY_MRAD}")
    return contrast(AWAY_MRAD, FAR_MM)


def strength_shown(page):
    """None: dashes, or nothing yet."""
    shown = page.text("#setup_beam .strength .number")
    return float(shown) if shown and shown[0].isdigit() else None


def signal_mark(page):
    return page.ask(f"{SIGNAL}?.dataset.mark")


def tone_hz(page):
    """The pitch that sounds now; None: it is silent."""
    shown = page.ask("document.querySelector('#setup_beam .tone')?.dataset.hz")
    return float(shown) if shown else None
