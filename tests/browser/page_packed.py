"""The files of the page as they come over the wire: packed by gzip to whoever takes that, with the same bytes in them."""

import contextlib
import gzip
import http.client

from page_bench import PAGE, bench, expect, in_mid_run, opened, sentence

SIZES = """performance.getEntriesByType('resource').concat(performance.getEntriesByType('navigation'))
           .filter((one) => !one.name.includes('/v1/')).map((one) => [one.name, one.encodedBodySize, one.decodedBodySize])"""


def shipped():
    """Path that is asked for: the file as it ships."""
    files = [path for path in PAGE.rglob("*") if path.is_file() and path.suffix != ".gz"]
    return {"/" if path.name == "index.html" else f"/page/{path.relative_to(PAGE)}": path for path in files}


def asked(b, path, accepts, has):
    """(status, fields, bytes) for a program that says this of itself."""
    wire = http.client.HTTPConnection("127.0.0.1", b.station["console"]["port"], timeout=10)
    with contextlib.closing(wire):
        wire.request("GET", path, headers={"Accept-Encoding": accepts, "If-None-Match": has})
        answer = wire.getresponse()
        return answer.status, answer.headers, answer.read()


@sentence("BrowserGetsThePagePackedAndShowsIt")
def in_the_browser(b):
    address = in_mid_run(b)
    with opened(address) as page:
        loaded = page.ask(SIZES)
        expect(len(loaded) > 20 and all(0 < came < meant for _, came, meant in loaded), f"not packed: {loaded}")
        page.wait("a good reading", lambda: "mm" in page.text("#now_reading .big"))
        page.open(address)  # out of what the browser has kept: it asks, and is told that nothing has changed
        page.wait("a good reading again", lambda: "mm" in page.text("#now_reading .big"))


@sentence("EveryFileOfThePageIsTheSamePackedAndUnpacked")
def every_file(b):
    in_mid_run(b)
    for path, file in shipped().items():
        tags = set()
        for accepts, unpacked in (("gzip", gzip.decompress), ("identity", bytes)):
            status, fields, got = asked(b, path, accepts, '"another"')
            expect(status == 200 and unpacked(got) == file.read_bytes(), f"{path} for {accepts}: {status}, {fields}")
            expect(fields["Content-Encoding"] == ("gzip" if accepts == "gzip" else None), f"{path} for {accepts}: {fields}")
            expect(fields["Vary"] == "Accept-Encoding", f"{path}: {fields}")
            status, again, got = asked(b, path, accepts, fields["ETag"])
            expect((status, got, again["ETag"]) == (304, b"", fields["ETag"]), f"{path} for {accepts}, unchanged: {status}, {again}")
            tags.add(fields["ETag"])
        expect(len(tags) == 2, f"{path}: both forms have one tag")


if __name__ == "__main__":
    bench.main()
