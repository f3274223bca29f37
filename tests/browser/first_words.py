"""Before the page starts: a browser that is too old, or runs no scripts, says so in words."""

import shutil

from page_bench import PAGE, Browser, bench, expect, sentence, with_page

LANGUAGES = ["en", "de", "ru", "zh-Hans"]
# Some of what acquisition/console/page/begin.js asks for, and how a browser that lacks it comes about.
TAKEN_AWAY = {"ResizeObserver": "delete window.ResizeObserver", "fetch": "delete window.fetch", "AbortController": "delete window.AbortController",
              "Path2D": "delete window.Path2D", "Object.hasOwn": "delete Object.hasOwn", "Array.prototype.at": "delete Array.prototype.at"}


def seen(page, selector):
    """Texts of what can be seen, by language."""
    return page.evaluate(f"Object.fromEntries([...document.querySelectorAll('{selector} p')].filter((one) => one.checkVisibility())"
                    ".map((one) => [one.lang, one.innerText]).reverse())")


def lacks(page):
    return page.evaluate("document.querySelector('#begin_lacks').textContent")


def expect_sentences(page, selector, word):
    said = page.wait(f"{selector} can be seen", lambda: seen(page, selector))
    expect(sorted(said) == sorted(LANGUAGES), f"languages: {said}")
    expect(all("axiscal status" in text for text in said.values()) and word in said["en"], f"what to do: {said}")
    others = page.evaluate("[...document.querySelectorAll('body *')].filter((one) => one.checkVisibility() && one.innerText)"
                      ".filter((one) => !one.closest('#begin')).map((one) => one.innerText)")
    expect(not others, f"nothing else is claimed: {others}")


@sentence("BrowserThatIsTooOldSaysSoInEachLanguageAndWhatItLacks")
def too_old(b):
    address = with_page(b)
    b.start()
    with Browser() as page:
        for name, way in TAKEN_AWAY.items():
            planted = page.tell("Page.addScriptToEvaluateOnNewDocument", source=way)["identifier"]
            page.open(address)
            expect_sentences(page, "#begin_old", "too old")
            expect(lacks(page) == name, lacks(page))
            page.tell("Page.removeScriptToEvaluateOnNewDocument", identifier=planted)
        page.open(address)
        page.wait_for_text("#now_reading", "mm")
        expect(not page.complaints(), "the console of the browser")


@sentence("GrammarThatTheBrowserDoesNotKnowIsToldAsAge")
def grammar(b):
    """As an old browser meets it: the scripts come, and it cannot read one of them."""
    address = with_page(b)
    folder = b.folder / "page"
    shutil.copytree(PAGE, folder)
    with open(folder / "freshness.js", "a", encoding="utf-8") as module:
        module.write("\n1 of tomorrow;\n")
    b.environment["AXISCAL_PAGE_PATH"] = str(folder)
    b.start()
    with Browser() as page:
        page.open(address)
        expect_sentences(page, "#begin_old", "too old")
        expect(lacks(page).startswith("SyntaxError"), lacks(page))


@sentence("BrowserWithoutScriptsSaysSoInEachLanguage")
def no_scripts(b):
    address = with_page(b)
    b.start()
    with Browser() as page:
        page.tell("Emulation.setScriptExecutionDisabled", value=True)  # of the page: the debugger still asks
        page.open(address)
        expect_sentences(page, "#begin noscript", "runs no scripts")


if __name__ == "__main__":
    bench.main()
