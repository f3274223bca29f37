#!/usr/bin/env python3
"""docs/api.md describes each call that the station answers, and each key of the status, and no other.

A call is a path that http_server.cpp compares the request with: in respond() it is read with GET, in remove() it ends
with DELETE, elsewhere in that file it changes with POST. The page's calls stand first in a row of its tables; any other page may name only calls that
there are. The sentences of a 404 must list them too. Keys of the status and of the stream are those that the functions
to_json() and trigger_json() write, compared table by table with the examples of the page.

api_described.py SOURCE_DIR     checks the sources
api_described.py --self-test    proves that planted differences are seen
"""
import json
import pathlib
import re
import sys

FOLDER = "acquisition/console"
CALL = r"/v1[\w/]*|/metrics\b"
PATH = re.compile(rf'==\s*"({CALL})"')
CONSTANT = re.compile(rf'string_view (\w+) = "({CALL})"')
METHODS = {"respond": "GET", "remove": "DELETE"}  # by function; any other: POST
ROW = re.compile(rf"^\| `(GET|POST|DELETE) ({CALL})", re.M)
MENTION = re.compile(rf"\b(GET|POST|DELETE) ({CALL})")
WRITER = re.compile(r"^(?:nlohmann::ordered_)?[jJ]son (?:to|trigger)_json\(const ([\w:<>]+)& \w+\) \{\n(.*?)^\}", re.M | re.S)
KEY = re.compile(r'\{"(\w+)",\s')
# the table of the example that each type becomes; trigger_json() and the whole are both written from StationStatus
TABLES = {"AxisView": "axis", "ChannelView": "channels", "InstrumentView": "instruments", "RunStatus": "run",
          "DriftView": "drift", "OutboxView": "outbox", "ToDo": "to_do"}
# the first key of the example that a type has for itself, and what it is called
EXAMPLES = {"FiguresSoFar": ("standing", "run.so_far"), "StoredRun": ("id", "a stored run")}


def functions_of(source):
    """Name and body of each member function of the face."""
    parts = re.split(r"^\S[^\n;]*HttpServer::Impl::(\w+)\(", source, flags=re.M)
    return list(zip(parts[1::2], parts[2::2]))


def calls_of(source, constants):
    """{("GET", "/v1/status"), ...} that the source answers."""
    found = set()
    for name, body in functions_of(source):
        method = METHODS.get(name, "POST")
        found.update((method, path) for path in PATH.findall(body))
        found.update((method, path) for word, path in constants.items() if re.search(rf"==\s*{word}\b", body))
    return found


def listed_by_404(source):
    """Name of the function, and the paths of the sentence that it answers an unknown path with."""
    for name, body in functions_of(source):
        for words in re.findall(r'sentence\(\s*404,((?:\s*"[^"]*")+)', body):
            yield name, re.findall(r"/v1[\w/]*", "".join(re.findall(r'"([^"]*)"', words)))


def example_of(page, key):
    """The example of the page whose first key is `key`; what it leaves open ("…") is null."""
    for block in re.findall(r"^```\n(\{.*?)^```", page, re.M | re.S):
        if block.startswith(f'{{"{key}"'):
            return json.loads(re.sub(r",…\]", "]", block.replace(":…", ":null").replace("[…]", "[]")))
    return {}


def keys_in(value):
    """Every key at any depth."""
    if isinstance(value, list):
        return set().union(*map(keys_in, value)) if value else set()
    return set(value).union(*map(keys_in, value.values())) if isinstance(value, dict) else set()


def differences(what, code, page):
    for key in sorted(code - page):
        yield f"docs/api.md does not describe {key} of {what}"
    for key in sorted(page - code):
        yield f"docs/api.md describes {key} of {what}, which the station does not write"


def calls_complaints(face, constants, page, others):
    """`others`: text by name of the other pages."""
    known, described = calls_of(face, constants), set(ROW.findall(page))
    for method, path in sorted(known - described):
        yield f"docs/api.md has no row for {method} {path}, which the station answers"
    for method, path in sorted(described - known):
        yield f"docs/api.md describes {method} {path}, which the station does not answer"
    for name, text in others.items():
        for method, path in sorted(set(MENTION.findall(text)) - known):
            yield f"{name} names {method} {path}, which the station does not answer"
    for name, listed in listed_by_404(face):
        expected = {path for method, path in known if name == "respond" or method == "POST"}
        for path in sorted(expected ^ set(listed)):
            yield f"the sentence of {name}() for an unknown path and the calls that there are differ in {path}"


def keys_complaints(writers, page):
    """`writers`: (type, body) of the functions that write JSON."""
    status, stream = example_of(page, "protocol"), example_of(page, "run")
    whole = set()
    for kind, body in writers:
        keys = set(KEY.findall(body))
        if kind in TABLES:
            yield from differences(TABLES[kind], keys, keys_in(status.get(TABLES[kind])))
        elif kind in EXAMPLES:
            first, what = EXAMPLES[kind]
            yield from differences(what, keys, keys_in(example_of(page, first)))
        elif kind == "StationStatus" and "protocol" in keys:
            whole = keys
        elif kind == "StationStatus":
            yield from differences("trigger", keys, keys_in(status.get("trigger")))
        elif "StreamView" in kind:
            yield from differences("the stream", keys, keys_in(stream))
    yield from differences("the status", whole, set(status))


FACE = '''Task<Response> HttpServer::Impl::respond(Request request) {
    if (target == stream_path) x();
    if (request.target() == "/v1/status") y();
    answer(sentence(404, "known are GET /v1/status, GET /v1/stream, "
                         "POST /v1/run"));
}
Task<Response> HttpServer::Impl::change(Request request) {
    if (target == "/v1/run") z();
    answer(sentence(404, "known are POST /v1/run"));
}
'''
PAGE = '''| `GET /v1/status` | as `GET /v1/status` |
| `GET /v1/stream?points=3` | b |
| `POST /v1/run` | c |
```
{"protocol":"x","axis":{"name":…,"still":[…]}}
```
'''
WRITERS = '''Json to_json(const AxisView& axis) {
    return {{"name", axis.name}, {"still", axis.still}};
}
nlohmann::ordered_json to_json(const StationStatus& status) {
    return {{"protocol", "x"},
            {"axis", to_json(status.axis)}};
}
'''


SO_FAR = '''nlohmann::ordered_json to_json(const FiguresSoFar& so_far) {
    limits.push_back({{"value_um", limit.value_um}});
    return {{"standing", so_far.standing}, {"limits", limits}};
}
'''


def self_test():
    def calls(face=FACE, page=PAGE, others=None):
        return len(list(calls_complaints(face, {"stream_path": "/v1/stream"}, page, others or {})))

    def keys(writers=WRITERS, page=PAGE):
        return len(list(keys_complaints(WRITER.findall(writers), page)))
    judged = [
        calls() == 0,
        calls(page=PAGE.replace("| `POST /v1/run` | c |\n", "")) == 1,
        calls(page=PAGE.replace("`POST /v1/run`", "`GET /v1/run`")) == 2,
        calls(page=PAGE + "| `POST /v1/run/dance` | d |\n") == 1,
        calls(face=FACE.replace("if (target == stream_path) x();", "")) == 2,  # the row, and the sentence
        calls(face=FACE.replace('== "/v1/run") z();', '== "/v1/walk") z();')) == 6,  # rows and both sentences, twice
        calls(face=FACE.replace('"known are POST /v1/run"', '"known are none"')) == 1,
        calls(others={"docs/a.md": "`POST /v1/run` and GET /v1/status"}) == 0,
        calls(others={"docs/a.md": "`POST /v1/status`"}) == 1,
        calls(page=PAGE + "| `DELETE /v1/run` | d |\n") == 1,
        calls(face=FACE + "Task<Response> HttpServer::Impl::remove(Request r) {\n    if (target == \"/v1/run\") w();\n}\n") == 1,
        calls(page=PAGE + "| `GET /metrics` | d |\n") == 1,
        calls(face=FACE.replace('"/v1/status") y();', '"/v1/status") y(); if (path == "/metrics") m();')) == 2,  # the row, and the sentence
        keys() == 0,
        keys(writers=WRITERS.replace('{"still", axis.still}', '{"still", a}, {"warm", b}')) == 1,
        keys(writers=WRITERS.replace('{"still", axis.still}', '{"quiet", a}')) == 2,
        keys(page=PAGE.replace('"protocol":"x",', '"protocol":"x","notes":[…],')) == 1,
        keys(writers=WRITERS + SO_FAR, page=PAGE + '```\n{"standing":"inside","limits":[{"value_um":1.0}]}\n```\n') == 0,
        keys(writers=WRITERS + SO_FAR) == 3,
    ]
    for nth, right in enumerate(judged):
        if not right:
            print(f"planted sample {nth} is judged wrongly")
    return 0 if all(judged) else 1


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])

    def read(name):
        return (root / name).read_text(encoding="utf-8")
    sources = {path.name: path.read_text(encoding="utf-8") for path in sorted((root / FOLDER).glob("*.[ch]pp"))}
    constants = {word: path for text in sources.values() for word, path in CONSTANT.findall(text)}
    page = read("docs/api.md")
    others = {str(path.relative_to(root)): path.read_text(encoding="utf-8")
              for path in [root / "README.md", *sorted((root / "docs").glob("*.md"))]}
    writers = [writer for text in sources.values() for writer in WRITER.findall(text)]
    found = [*calls_complaints(sources["http_server.cpp"], constants, page, others), *keys_complaints(writers, page)]
    calls = calls_of(sources["http_server.cpp"], constants)
    seen = {*TABLES, *EXAMPLES} - {kind for kind, _ in writers}
    found += [f"no function writes {kind} any more: look at this guard" for kind in sorted(seen)]
    print("\n".join(found))
    print(f"{len(calls)} calls, {len(keys_in(example_of(page, 'protocol')))} keys of the status")
    return 1 if found or not calls else 0


sys.exit(main())
