"""What a finger does on the page at the machine. The first touch after a pause of this computer only wakes the page, so
each touch is repeated until what it is for has come."""

SHEET_HIDDEN = "document.querySelector('#run_sheet').hidden"
MAY_ONLY_LOOK = "document.querySelector('[data-order=arm]').title.includes('axiscal pair')"


def is_shown(page, screen):
    return page.ask(f"!document.querySelector('#screen_{screen}').hidden")


def go(page, screen):
    page.wait(f"the screen {screen}", lambda: is_shown(page, screen) or page.click(f"nav [data-screen={screen}]"))


def is_on(page, order):
    return page.ask(f"document.querySelector('[data-order={order}]').getAttribute('aria-disabled') === null")


def open_sheet(page, order):
    page.wait(f"the sheet of {order}", lambda: not page.ask(SHEET_HIDDEN) or page.click(f"[data-order={order}]"))


def pick_first_point(page):
    """In the table of the run's points, which is closed by that. The page paints a moment after the touch."""

    def picked():
        table_is_open = page.ask("document.querySelector('#run_table').hidden === false")
        if page.text("#run_picked") and not table_is_open:
            return True
        page.element("#run_table td button" if table_is_open else "#run_plot .table_button").click()
        return False

    page.wait("a point is picked", picked)


def send_sheet(page, text):
    """`text` in the first field, and the order is given."""

    def sent():
        if page.ask(SHEET_HIDDEN):
            return True
        field = page.element("#run_sheet input")
        if field.get_attribute("value") != text:
            field.clear()
            field.send_keys(text)
        elif page.ask("document.querySelector('#run_sheet [type=submit]')?.disabled === false"):
            page.element("#run_sheet [type=submit]").click()
        return False

    page.wait("the order of the sheet is taken", sent)


def pair(page, code):
    """By the code that the command line shows."""
    go(page, "run")
    page.wait("this browser may only look", lambda: page.ask(MAY_ONLY_LOOK))
    open_sheet(page, "arm")
    page.wait("the sheet asks for the code", lambda: page.ask("document.querySelector('#run_sheet input')?.inputMode === 'numeric'"))
    send_sheet(page, code)
    page.wait("its orders are its own", lambda: not page.ask(MAY_ONLY_LOOK))


def code_of(shown):
    """The eight digits in what `axiscal pair` prints."""
    return shown.split("Code:")[1].split("counts")[0].strip()


def state_machine(page, state, control_compensation):
    """On the sheet that arms, which asks where the station file does not say it."""
    page.driver.execute_script("document.querySelector('#run_sheet [name=state]').value = arguments[0]", state)
    page.element("#run_sheet [name=control_compensation]").send_keys(control_compensation)


def arm(page, datum_mm, *machine, seed=None):
    """machine: (state, control compensation), and the seed of the part program, where the station file does not say it."""
    page.wait("a run may be armed", lambda: is_on(page, "arm"))
    open_sheet(page, "arm")
    if machine:
        state_machine(page, *machine)
    if seed is not None:
        page.element("#run_sheet [name=seed]").send_keys(str(seed))
    send_sheet(page, str(datum_mm))


def points_drawn(page, screen):
    """How many points the page has put on the canvas of a screen's plot; None while it has drawn none of it."""
    return page.ask(f"""((drawing) => drawing?.dataset.positive === undefined ? null
        : Number(drawing.dataset.positive) + Number(drawing.dataset.negative))(document.querySelector('#{screen}_plot .drawing'))""")
