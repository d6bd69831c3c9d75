#!/usr/bin/env python3
"""Damaged files of every kind, given to the program itself.

    python3 tests/fuzz.py PROGRAM [SEED] [CASES] [--workers N] [--keep FOLDER]

Every case is a right file (a model with its tables and fits, a case of the gap diagnosis, a
certificate, a recipe with its recordings, a table of results, a workbook, a saved result, a digital
calibration certificate, a budget to import, costs of a plan, parts of a run) with some
changes, and a command that reads it; the
seed and the number of the case tell which. In the end stand the exit codes that were seen, the
slowest case and the largest resident memory. It fails where a code is not 0, 2 or 3, a case takes
more than 10 s (by the clock and of processor time) or 1 GiB, an answer in JSON is none, or the program says that it
panicked; such cases are left in the folder that --keep names.
"""

import argparse, collections, io, json, multiprocessing, os, random, re, resource, shutil, signal
import struct, subprocess, sys, tempfile, time, zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MOST_SECONDS, MOST_KIB, PATIENCE = 10.0, 1 << 20, 60.0

NUMBERS = ["0", "-0.0", "1", "-1", "2", "0.5", "1e-300", "5e-324", "1e308", "-1e308", "1e400", "1e-400",
           "9007199254740993", "18446744073709551615", "18446744073709551616", "-2147483649", "1e15",
           "0.1e1", "3.141592653589793", "1000000", "100000", "1e6", "1e9", "0.95", "1.0000000000000002"]
WORDS = ["", "x", "y", "1", "m", "m/s^2", "degC", "K", "dB", "%", "ppm", "rad", "1e9", "sin(x)", "x/0", "-",
         "../x.csv", "/etc/passwd", "data.csv", "none.csv", "normal", "rectangular", "t", "readings",
         "samples", "result", "constant", "triangular", "beta", "gamma", "poisson-count", "true", "null",
         "\u0000", "\u001b[2J", "\u202e", "µ", "5 %", "1 % + 2 V", "2 V", "1e400 V", "x^x^x", "((((", "))",
         "kelvin(x)", "x/[m]", "20 [degC]", "nan", "inf", "1,5", "'", "\"", "=1+1", "<script>", "adaptive",
         "max(x,y)", "if(x>0,x,y)", "10*log10(x)", "[c]*x", "x" * 300, "9" * 400, "a*" * 200 + "a"]


BUDGETS = {
    "b.csv": b"Calibration,,,,,\nR = U/I,,,,,\nQuantity,Estimate,Unit,+-,Distribution,Divisor,Degrees of freedom\n"
             b"U,5.0112,V,0.0046,normal,2,50\nI,0.01,A,0.00001,rectangular,sqrt(3),inf\nR,501,ohm,,,,\n",
    "d.csv": "Größe;Schätzwert;Einheit;Halbbreite;Verteilung;Sensitivitätskoeffizient\nm_S;10000,005;g;0,045;Rechteck;1\n"
             "dm;0,02;g;0,0144;Rechteck;1\n".encode(),
}


def bases():
    """The right files: kind, name, bytes, and the others that it needs."""
    found = []

    def read(path):
        with open(path, "rb") as file:
            return file.read()

    def folder(path):
        return {name: read(os.path.join(path, name)) for name in sorted(os.listdir(path))
                if os.path.isfile(os.path.join(path, name)) and name != "README.md"}

    models = os.path.join(ROOT, "models")
    for top in [models, os.path.join(models, "formulas")]:
        others = {k: v for k, v in folder(top).items() if not k.endswith(".json")}
        for name, data in folder(top).items():
            if name.endswith(".json") and len(data) < 20000:
                found.append(("model", name, data, others))
    cases = os.path.join(ROOT, "tests", "cases")
    for name in sorted(os.listdir(cases)):
        if os.path.isdir(os.path.join(cases, name)):
            files = folder(os.path.join(cases, name))
            data = files.pop("model.json", None)
            if data and len(data) < 20000:
                found.append(("model", "model.json", data, files))
                tables = [n for n in files if n.endswith((".csv", ".txt"))]
                for table in tables:
                    found.append(("table", table, files[table], {**files, "model.json": data}))
    for top, kind, main in [("gap", "gap", "case.json"), ("recordings", "recipe", "recipe.json")]:
        for name in sorted(os.listdir(os.path.join(models, top))):
            path = os.path.join(models, top, name)
            if os.path.isdir(path):
                files = folder(path)
                data = files.pop(main, None)
                if data and sum(map(len, files.values())) < 3_000_000:
                    found.append((kind, main, data, files))
                    for other in files:
                        found.append((kind + "-data", other, files[other], {**files, main: data}))
    published = folder(os.path.join(models, "examples", "published"))
    others = {k: v for k, v in published.items() if k.endswith(".csv")}
    for name, data in published.items():
        if name.endswith(".json") and name != "expected.json" and b'"result"' not in data and len(data) < 20000:
            found.append(("model", name, data, others))
    plan = folder(os.path.join(models, "plan"))
    for name, data in plan.items():
        if b'"costs"' in data:
            found.append(("costs", name, data, {k: v for k, v in plan.items() if k != name}))
    found += [("import", name, data, {}) for name, data in BUDGETS.items()]
    found.append(("import-book", "t.xlsx", workbook(BUDGETS["b.csv"]), {}))
    for name, data in folder(os.path.join(models, "certificates")).items():
        others = {n: d for n, d in folder(models).items() if n.endswith(".json")}
        found.append(("certificate", name, data.replace(b"../", b""), others))
    dcc = read(os.path.join(ROOT, "tests", "readers", "certificate.json"))
    plane = read(os.path.join(models, "inclined_plane.json"))
    found.append(("certificate", "c.json", dcc.replace(b"../../models/", b""), {"inclined_plane.json": plane}))
    pairs = b"label,x1,U1,x2,U2,k1,k2,r\na,1.0,0.1,1.1,0.2,2,2,0\n\"b, c\",5e3,1,5001,1,2,2,0.5\nd,0,1,2,1,2,2,0\n"
    labs = b"label;x;U\na;1,0;0,1\nb;1,1;0,2\nc;3;0,3\nd;1,05;0,1\n"
    found += [("compare", "t.csv", pairs, {}), ("compare", "t.csv", labs, {})]
    found += [("workbook", "t.xlsx", workbook(text), {}) for text in (pairs, labs.replace(b",", b".").replace(b";", b","))]
    samples = "\n".join(str(1 + i % 7) for i in range(200)).encode()
    model = b'{"inputs": {"x": {"distribution": "samples", "file": "s.txt"}, "m": {"distribution": "normal", "mean": 1, "std": 0.1}}, "equations": {"y": "x*m"}, "outputs": {"y": {}}}'
    found.append(("table", "s.txt", samples, {"model.json": model}))
    frames = [(int(12000 * ((i * 37) % 200 - 100) / 100), i % 5) for i in range(4000)]
    wav = struct.pack("<4sI4s4sIHHIIHH4sI", b"RIFF", 36 + 4 * len(frames), b"WAVE", b"fmt ", 16, 1, 2, 1000, 4000, 4, 16, b"data", 4 * len(frames))
    wav += b"".join(struct.pack("<hh", *frame) for frame in frames)
    header = "{'descr': '<f8', 'fortran_order': False, 'shape': (4000, 2), }".ljust(117) + "\n"
    npy = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + b"".join(struct.pack("<dd", *map(float, f)) for f in frames)
    text = b"a,b\n" + b"".join(b"%d,%d\n" % f for f in frames)
    for name, data in [("r.wav", wav), ("r.npy", npy), ("r.csv", text)]:
        column = '"a"' if name.endswith("csv") else "1"
        recipe = '{"recordings": {"r": {"sampling_rate": 1000}}, "channels": {"a": {"recording": "r", "column": %s, "unit": "V"}}, "rows": [{"files": {"r": "%s"}, "frequency": 5}], "trials": 50}' % (column, name)
        found.append(("recipe-data", name, data, {"recipe.json": recipe.encode()}))
        found.append(("recipe", "recipe.json", recipe.encode(), {name: data}))
    return found


def workbook(text):
    """A workbook with the cells of a CSV text, some of its strings shared."""
    import csv
    rows, strings = [], []
    for r, line in enumerate(csv.reader(io.StringIO(text.decode())), 1):
        cells = []
        for c, cell in enumerate(line):
            place = "%s%d" % (chr(65 + c), r)
            try:
                float(cell)
                cells.append('<c r="%s"><v>%s</v></c>' % (place, cell))
            except ValueError:
                cells.append('<c r="%s" t="s"><v>%d</v></c>' % (place, len(strings)))
                strings.append("<si><t>%s</t></si>" % cell)
        rows.append('<row r="%d">%s</row>' % (r, "".join(cells)))
    main = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'
    office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    relations = '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">%s</Relationships>'
    relation = '<Relationship Id="%s" Type="' + office + '/%s" Target="%s"/>'
    return pack([
        ("[Content_Types].xml", '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>'),
        ("_rels/.rels", relations % relation % ("r1", "officeDocument", "xl/workbook.xml")),
        ("xl/workbook.xml", '<workbook %s xmlns:r="%s"><sheets><sheet name="a" sheetId="1" r:id="r1"/></sheets></workbook>' % (main, office)),
        ("xl/_rels/workbook.xml.rels", relations % (relation % ("r1", "worksheet", "worksheets/sheet1.xml") + relation % ("r2", "sharedStrings", "sharedStrings.xml"))),
        ("xl/sharedStrings.xml", "<sst %s>%s</sst>" % (main, "".join(strings))),
        ("xl/worksheets/sheet1.xml", '<worksheet %s><dimension ref="A1:H9"/><sheetData>%s</sheetData></worksheet>' % (main, "".join(rows))),
    ])


def pack(parts):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in parts:
            archive.writestr(name, text)
    return out.getvalue()


def bytes_changed(choice, data, times):
    """Some bytes flipped, taken out, doubled, put in."""
    data = bytearray(data)
    for _ in range(times):
        at = choice.randrange(len(data) + 1)
        some = choice.choice([1, 1, 2, 4, 8, choice.randrange(1, 200)])
        kind = choice.randrange(6)
        if kind == 0 and at < len(data):
            data[at] ^= 1 << choice.randrange(8)
        elif kind == 1:
            data[at:at + some] = bytes(choice.randrange(256) for _ in range(choice.choice([1, some])))
        elif kind == 2:
            del data[at:at + some]
        elif kind == 3:
            data[at:at] = data[at:at + some] * choice.choice([1, 2, 50])
        elif kind == 4:
            data[at:at + some] = choice.choice([b"\xff", b"\0"]) * some
        else:
            data = data[:at]
    return bytes(data)


def text_changed(choice, data, times):
    """Numbers and words of a text replaced, lines taken out, doubled, exchanged."""
    text = data.decode("utf-8", "replace")
    for _ in range(times):
        kind = choice.randrange(6)
        if kind <= 1:
            numbers = list(re.finditer(r"-?\d+(\.\d+)?([eE][-+]?\d+)?", text))
            if numbers:
                found = choice.choice(numbers)
                text = text[:found.start()] + choice.choice(NUMBERS) + text[found.end():]
        elif kind == 2:
            words = list(re.finditer(r"[^\s,;:{}\[\]\"<>/=]+", text))
            if words:
                found = choice.choice(words)
                text = text[:found.start()] + choice.choice(WORDS) + text[found.end():]
        else:
            lines = text.splitlines(True)
            if lines:
                at = choice.randrange(len(lines))
                if kind == 3:
                    del lines[at]
                elif kind == 4:
                    # as long as no reader takes, but not longer than this machine has room for
                    most = 1 + 60_000_000 // len(lines[at])
                    lines[at:at] = [lines[at]] * min(choice.choice([1, 1, 3, 300]), most)
                else:
                    lines[at] = choice.choice(["", "#", "\"", ";", "\r", "\ufeff", "a,b,c"]) + lines[at]
                text = "".join(lines)
        if len(text) > 60_000_000:
            break
    return text.encode("utf-8", "surrogatepass")


def json_changed(choice, data, times, others):
    """Values of a JSON file replaced, keys taken out, renamed, or taken from another file."""
    try:
        value = json.loads(data)
    except ValueError:
        return text_changed(choice, data, times)
    for _ in range(times):
        places = []

        def visit(node):
            if isinstance(node, dict):
                places.extend((node, key) for key in node)
                for inner in node.values():
                    visit(inner)
            elif isinstance(node, list):
                places.extend((node, place) for place in range(len(node)))
                for inner in node[:50]:
                    visit(inner)

        visit(value)
        if not places:
            break
        node, key = choice.choice(places)
        kind = choice.randrange(14)
        old = node[key]
        is_number = isinstance(old, (int, float)) and not isinstance(old, bool)
        if kind >= 10 and is_number:
            # another one of the same kind, which most files survive
            node[key] = old * choice.choice([0.5, 2, -1, 1.1, 10, 1e-3, 1e3]) if choice.randrange(3) else choice.choice([0, 1, 2, 0.5, 0.95])
        elif kind >= 10 and isinstance(old, str):
            same = [member for member in texts_of(others, key) if isinstance(member, str)] if isinstance(key, str) else []
            node[key] = choice.choice(same or WORDS)
        elif kind <= 3 or kind >= 10:
            number = choice.choice(NUMBERS)
            node[key] = float(number) if not re.fullmatch(r"-?\d+", number) else int(number)
            if isinstance(node[key], float) and abs(node[key]) == float("inf"):
                node[key] = 1e308
        elif kind <= 5:
            node[key] = choice.choice(WORDS)
        elif kind == 6:
            del node[key]
        elif kind == 7:
            node[key] = choice.choice([None, True, False, [], {}, [node[key]], {"value": node[key]}])
        else:
            try:
                other = json.loads(choice.choice(others))
            except ValueError:
                continue
            donors = []

            def collect(of):
                if isinstance(of, dict):
                    donors.extend(of.items())
                    for inner in of.values():
                        collect(inner)

            collect(other)
            if donors:
                name, donor = choice.choice(donors)
                if isinstance(node, dict):
                    node[name] = donor
                else:
                    node[key] = donor
    return json.dumps(value).encode("utf-8", "surrogatepass")


TEXTS = {}


def texts_of(others, key):
    """What the right files have under a key."""
    if not TEXTS:
        def collect(of):
            if isinstance(of, dict):
                for name, member in of.items():
                    TEXTS.setdefault(name, []).append(member)
                    collect(member)
            elif isinstance(of, list):
                for member in of:
                    collect(member)

        for text in others:
            try:
                collect(json.loads(text))
            except ValueError:
                pass
    return TEXTS.get(key, [])


def book_changed(choice, data, times):
    """Parts of a workbook changed, or the archive itself."""
    if choice.randrange(4) == 0:
        return bytes_changed(choice, data, times)
    parts = []
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        parts = [(name, archive.read(name)) for name in archive.namelist()]
    for _ in range(times):
        at = choice.randrange(len(parts))
        name, content = parts[at]
        kind = choice.randrange(4)
        if kind == 0:
            content = bytes_changed(choice, content, 1)
        elif kind == 1:
            cell = choice.choice([b"XFD1048576", b"ZZZZZZZZ99999999999", b"A0", b"", b"A4294967296", b"B2:A1", b"XFD1"])
            content = re.sub(rb'(r|ref)="[A-Z0-9:]*"', lambda m: m.group(1) + b'="' + cell + b'"' if choice.randrange(6) == 0 else m.group(0), content)
        else:
            content = text_changed(choice, content, 1)
        parts[at] = (name, content)
    return pack(parts)


def prepared(program):
    """The right files, with saved results made by the program."""
    found = bases()
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(ROOT, "models", "inclined_plane.json")
        saved = os.path.join(folder, "r.json")
        subprocess.run([program, "run", model, "--trials", "2000", "--save", saved, "--quiet"], check=True, stdout=subprocess.DEVNULL)
        with open(saved, "rb") as file:
            result = json.load(file)
    with tempfile.TemporaryDirectory() as folder:
        # what the program writes and reads again: parts of a run, a digital certificate, a workbook
        with open(model, "rb") as file:
            plane = file.read()
        parts = {}
        with open(os.path.join(folder, "m.json"), "wb") as file:
            file.write(plane)
        for part in "12":
            name = part + ".part"
            subprocess.run([program, "run", "m.json", "--trials", "6000", "--blocks", part + "/2", "--partial", name, "--quiet"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
            with open(os.path.join(folder, name), "rb") as file:
                parts[name] = file.read()
        for name, data in parts.items():
            found.append(("parts", name, data, {**{k: v for k, v in parts.items() if k != name}, "m.json": plane}))
        with open(os.path.join(ROOT, "tests", "readers", "certificate.json"), "rb") as file:
            stated = file.read().replace(b"../../models/inclined_plane.json", b"m.json")
        with open(os.path.join(folder, "c.json"), "wb") as file:
            file.write(stated)
        subprocess.run([program, "certificate", "c.json", "--trials", "0", "--format", "dcc", "--output", "ref.xml", "--quiet"], cwd=folder, check=True, stderr=subprocess.DEVNULL)
        subprocess.run([program, "run", "m.json", "--trials", "0", "--format", "xlsx", "--output", "own.xlsx", "--quiet"], cwd=folder, check=True)
        with open(os.path.join(folder, "ref.xml"), "rb") as file:
            dcc = file.read()
        with open(os.path.join(folder, "own.xlsx"), "rb") as file:
            found.append(("import-book", "own.xlsx", file.read(), {}))
    refer = {"inputs": {"v": {"distribution": "dcc", "file": "ref.xml", "quantity": 0, "index": 0}}, "equations": {"y": "2*v"}, "outputs": {"y": {}}, "check_units": False}
    found.append(("dcc", "ref.xml", dcc, {"use.json": json.dumps(refer).encode()}))
    found.append(("model", "use.json", json.dumps(refer).encode(), {"ref.xml": dcc}))
    output = next(iter(result["outputs"]))
    use = {"inputs": {"a": {"distribution": "result", "file": "r.json", "output": output}}, "equations": {"y": "2*a"}, "outputs": {"y": {"unit": result["outputs"][output]["unit"]}}}
    old = {key: value for key, value in result.items() if not key.startswith("sha256")}
    for data in (result, old):
        found.append(("result", "r.json", json.dumps(data).encode(), {"use.json": json.dumps(use).encode()}))
    return found


WEIGHTS = {"model": 60, "table": 8, "gap": 3, "gap-data": 1, "recipe": 4, "recipe-data": 6, "certificate": 4, "compare": 6, "workbook": 6, "result": 4,
           "dcc": 5, "import": 4, "import-book": 3, "costs": 1, "parts": 4}


def command(choice, kind, name, small):
    page = choice.choice(["table", "json", "json", "csv", "markdown", "latex", "html"])
    few = choice.choice(["0", "100", "1000", "5000"])
    if kind == "model":
        return choice.choice([
            ["run", name, "--trials", few, "--format", page],
            ["run", name, "--trials", few, "--format", page],
            ["run", name, "--trials", few, "--format", "xlsx"],
            ["run", name, "--trials", "adaptive", "--max-trials", "40000", "--format", "json"],
            ["check", name, "--format", "json"],
            ["diff", name, "original.json"],
            ["assumptions", name, "--trials", "20000", "--format", choice.choice(["table", "json"])],
        ][:None if small else -1] if choice.randrange(10) == 0 else [
            ["run", name, "--trials", few, "--format", page], ["check", name]])
    if kind == "table":
        return ["run", "model.json", "--trials", few, "--format", page]
    if kind in ("gap", "gap-data"):
        return ["gap", "case.json", "--format", choice.choice(["table", "json", "html", "csv"])] if choice.randrange(3) else ["check", "case.json"]
    if kind in ("recipe", "recipe-data"):
        return ["observe", "recipe.json", "--format", choice.choice(["table", "json", "csv"])]
    if kind == "certificate":
        return ["certificate", name, "--trials", choice.choice(["0", "100"]), "--format", choice.choice(["table", "json", "dcc", "latex", "html", "xlsx", "csv"])]
    if kind in ("compare", "workbook"):
        return ["compare", name, "--format", choice.choice(["table", "json", "html", "markdown", "csv"])]
    if kind == "dcc":
        return choice.choice([["check", "use.json"], ["run", "use.json", "--trials", few, "--format", page]])
    if kind in ("import", "import-book"):
        return ["import", name]
    if kind == "costs":
        return choice.choice([["check", name], ["plan", "source.json", "--target", "U(source) <= 8 uV", "--cost", name, "--format", choice.choice(["table", "json"])]])
    if kind == "parts":
        return ["merge", ".", "--model", "m.json", "--format", choice.choice(["table", "json"])]
    flags = ["--accept-changed"] if choice.randrange(2) else []
    return choice.choice([["run", "use.json", "--trials", few, "--format", page], ["diff", "r.json", "r.json"]]) + flags


def damaged(choice, kind, name, data, texts):
    times = choice.choice([1, 1, 1, 2, 2, 3, 6])
    if kind in ("workbook", "import-book"):
        return book_changed(choice, data, times)
    if name.endswith((".wav", ".npy", ".part")):
        head = data[:200]
        return bytes_changed(choice, head, times) + data[200:] if choice.randrange(2) else bytes_changed(choice, data, times)
    way = choice.randrange(10)
    if name.endswith(".json"):
        if way < 7:
            return json_changed(choice, data, times, texts)
        return text_changed(choice, data, times) if way < 9 else bytes_changed(choice, data, times)
    return text_changed(choice, data, times) if way < 7 else bytes_changed(choice, data, times)


def limit():
    # killed rather than dragging the machine along; what counts is what is resident
    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))


def work(job):
    program, seed, numbers, keep, found = job
    by_kind = collections.defaultdict(list)
    for base in found:
        by_kind[base[0]].append(base)
    kinds = [kind for kind in WEIGHTS if by_kind[kind]]
    weights = [WEIGHTS[kind] for kind in kinds]
    texts = [data for kind, name, data, _ in found if name.endswith(".json") and len(data) < 20000]
    codes, slowest, largest, bad = collections.Counter(), (0, ""), (0, ""), []
    folder = tempfile.mkdtemp(prefix="gumption-fuzz-")
    for number in numbers:
        choice = random.Random(seed * 1_000_003 + number)
        kind = choice.choices(kinds, weights)[0]
        _, name, data, others = choice.choice(by_kind[kind])
        changed = damaged(choice, kind, name, data, texts)
        if kind == "recipe":
            # as the other commands have few trials from their arguments
            changed = re.sub(rb'("trials": *)\d{6,}\b', rb'\g<1>2000', changed)
        for old in os.listdir(folder):
            os.remove(os.path.join(folder, old))
        files = {**others, name: changed}
        if kind == "model":
            files["original.json"] = data
        for file, content in files.items():
            with open(os.path.join(folder, file), "wb") as out:
                out.write(content)
        # the audit of assumptions varies every input by itself, which takes its time of many
        arguments = command(choice, kind, name, len(data) < 2500)
        out_file, err_file = os.path.join(folder, ".out"), os.path.join(folder, ".err")
        with open(out_file, "wb") as out, open(err_file, "wb") as err:
            child = subprocess.Popen([program] + arguments, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err, preexec_fn=limit)
            timer = None
            started = time.monotonic()
            signal.signal(signal.SIGALRM, lambda *_: child.kill())
            signal.setitimer(signal.ITIMER_REAL, PATIENCE)
            _, status, used = os.wait4(child.pid, 0)
            signal.setitimer(signal.ITIMER_REAL, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            wall = time.monotonic() - started
        code, cpu = child.returncode, used.ru_utime + used.ru_stime
        what = "%d:%d %s %s" % (seed, number, kind, " ".join(arguments))
        codes[code] += 1
        slowest, largest = max(slowest, (cpu, what)), max(largest, (used.ru_maxrss, what))
        with open(err_file, "rb") as err:
            said = err.read(1 << 20)
        reasons = []
        if code not in (0, 2, 3):
            reasons.append("exit code %d" % code)
        # less than both on a busy machine and with several threads
        if min(cpu, wall) > MOST_SECONDS:
            reasons.append("%.1f s (%.1f s by the clock)" % (cpu, wall))
        if used.ru_maxrss > MOST_KIB:
            reasons.append("%d MiB" % (used.ru_maxrss >> 10))
        if b"panicked" in said:
            reasons.append("a panic")
        if code in (0, 3) and arguments[-1] == "json" and "--format" in arguments:
            try:
                with open(out_file, "rb") as out:
                    json.load(out, parse_constant=lambda _: 1 / 0)
            except (ValueError, ZeroDivisionError):
                reasons.append("an answer that is no JSON")
        if reasons:
            bad.append("%s: %s" % (what, ", ".join(reasons)))
            if keep:
                place = os.path.join(keep, "%d-%d" % (seed, number))
                shutil.copytree(folder, place, dirs_exist_ok=True)
    shutil.rmtree(folder)
    return codes, slowest, largest, bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("seed", type=int, nargs="?", default=1)
    parser.add_argument("cases", type=int, nargs="?", default=2000)
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--keep")
    told = parser.parse_args()
    program = os.path.abspath(told.program)
    if told.keep:
        os.makedirs(told.keep, exist_ok=True)
    os.environ["RAYON_NUM_THREADS"] = "2"
    found = prepared(program)
    last, part, started = told.first + told.cases, 250, time.monotonic()
    jobs = [(program, told.seed, range(n, min(n + part, last)), told.keep, found) for n in range(told.first, last, part)]
    codes, slowest, largest, bad, done = collections.Counter(), (0, ""), (0, ""), [], 0
    with multiprocessing.Pool(told.workers) as pool:
        for job, (some, slow, large, wrong) in enumerate(pool.imap(work, jobs), 1):
            codes += some
            slowest, largest = max(slowest, slow), max(largest, large)
            for line in wrong:
                print(line, flush=True)
            bad += wrong
            if job % 20 == 0:
                print("%d of %d cases, %.0f s" % (sum(codes.values()), told.cases, time.monotonic() - started), file=sys.stderr)
    print("%d cases in %.0f s" % (sum(codes.values()), time.monotonic() - started))
    print("exit codes: " + ", ".join("%d: %d" % pair for pair in sorted(codes.items())))
    print("slowest: %.2f s of processor time (%s)" % slowest)
    print("largest: %d MiB (%s)" % (largest[0] >> 10, largest[1]))
    print("%d cases are not as they should be" % len(bad))
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
