"""Digits that are read from afar, and targets that a glove meets, on each screen and in each size of screen."""

from page_bench import SCREENS, SIZES, bench, expect, go, in_mid_run, is_shown, opened, sentence

TARGET_PX, DIGITS_PX = 72, 96

# What can be touched and is seen, smaller than a target; "inert" is what lies below a sheet.
SMALL = f"""[...document.querySelectorAll('button, a[href], input, select')]
    .filter((one) => one.checkVisibility() && !one.closest('[inert]'))
    .map((one) => [one.id || one.name || one.innerText, one.getBoundingClientRect()])
    .filter(([, box]) => Math.min(box.width, box.height) < {TARGET_PX} - 0.5)
    .map(([name, box]) => `${{name}}: ${{box.width}} by ${{box.height}}`)"""


@sentence("ReadingHas96PixelsAndEveryTargetHasRoomForAFinger")
def sizes(b):
    address = in_mid_run(b)
    with opened(address) as page:
        found = []
        for size in SIZES:
            page.resize(size)
            for screen in SCREENS:
                go(page, screen)
                page.wait("it is painted", lambda screen=screen: is_shown(page, screen) and page.ask(f"document.querySelectorAll('#screen_{screen} *').length > 3"))
                found += [f"{screen}, {size[0]}x{size[1]}: {small}" for small in page.ask(SMALL)]
        expect(not found, "\n".join(found))
        page.resize(SIZES[0])
        go(page, "now")
        digits = page.ask("getComputedStyle(document.querySelector('#now_reading .big .number')).fontSize")
        expect(digits == f"{DIGITS_PX}px", f"the reading has {digits}")


if __name__ == "__main__":
    bench.main()
