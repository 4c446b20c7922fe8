"""Breaks exports one by one: each fault has to be found by the step that is there for it."""

import shutil
import sqlite3
import sys
import tempfile
import zipfile
from pathlib import Path

import openpyxl

import validate

# Step that finds it, file, text there, text in its place (first place only).
TEXTS = [
    ("lif", "lif.json", '"rotationAllowed":false', '"rotationAllowed":"no"'),
    ("lif", "lif.json", '"lifVersion":"1.0.0"', '"lifVersion":1'),
    ("lif", "lif.json", '"interactionNodeIds":[', '"interactionNodeIds":[], "others":['),
    ("lif", "lif.json", '"startNodeId":"', '"startNodeId":"nowhere-'),
    ("lif", "lif.json", '"exportTimestamp":"', '"exportTimestamp":"+'),
    ("lif", "lif-2.0.json", '"orientationType":"TANGENTIAL"', '"orientationType":"SIDEWAYS"'),
    ("zones", "vda5050-zone-set.json", '"BIDIRECTED"', '"SOMEHOW"'),
    ("zones", "vda5050-zone-set.json", '"bidirectedLimitation":"SOFT"', '"bidirectedLimitation":"MILD"'),
    ("zones", "vda5050-zone-set.json", '"limitation":"SOFT"', '"limitation":"MILD"'),
    ("zones", "vda5050-zone-set.json", '"timestamp":"', '"timestamp":"+'),
    ("zones", "vda5050-download-map.json", '"key":"mapHash","value":"', '"key":"mapHash","value":"0'),
    ("route", "nav2-route.geojson", '"width":', '"width":null, "was":'),
    ("route", "nav2-route.geojson", '"startid":', '"startid":9'),
    ("route", "nav2-route.geojson", '"MultiLineString","coordinates":[[', '"MultiLineString","coordinates":[[[0.5,0.5],'),
    ("vector_objects", "nav2-vector-objects.yaml", "points: [", "points: [1, "),
    ("vector_objects", "nav2-vector-objects.yaml", "value: 100", "value: 0"),
    ("rmf", "rmf-nav-graph.yaml", 'name: "N', 'name: "N" # "'),
    ("rmf", "rmf-nav-graph.yaml", "lanes:\n    - [", "lanes:\n    - [99999999, "),
    ("rmf", "rmf-nav-graph.yaml", "vertices:\n    - [", "vertices:\n    - [1e-17, "),
    ("rmf", "rmf.building.yaml", "bidirectional: [4, true]", "bidirectional: [4, false]"),
    ("same_graph", "rmf-nav-graph.yaml", "lanes:\n    - [0, ", "lanes:\n    - [1, "),
    ("tables", "locations.csv", "\n01-", "\n=01-"),
    ("tables", "locations.csv", "\n01-001,", "\n01-001,,"),
    ("graphml", "graph.graphml", '<data key="x">', '<data key="x">1'),
    ("graphml", "graph.graphml", "</graph>", "</grph>"),
    ("masks", "map.map", "type octile", "type square"),
    ("masks", "map.map", "map\n@", "map\n#"),
]

# Step that finds it, archive, member, bytes there, bytes in their place (all places).
MEMBERS = [
    ("masks", "nav2-keepout.zip", "nav2-keepout.pgm", b"\xfe", b"\x00"),
    ("masks", "nav2-keepout.zip", "nav2-keepout.pgm", b"\x00", b"\xcd"),
    ("masks", "nav2-keepout.zip", "nav2-keepout.yaml", b"mode: trinary", b"mode: scale"),
    ("masks", "nav2-speed.zip", "nav2-speed.yaml", b"resolution: ", b"resolution: 1e-17 # "),
    ("bundle", "bundle.zip", "lif.json", b'"stillage"', b'"somebody"'),
    ("bundle", "bundle.zip", "SHA256SUMS", b"lif.json", b"life.json"),
]


def change_text(path, old, new):
    text = path.read_text(encoding="utf-8")
    if old not in text:
        return False
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return True


def change_member(path, member, old, new):
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    head = files[member].index(b"255\n") + 4 if member.endswith(".pgm") else 0
    changed = files[member][:head] + files[member][head:].replace(old, new)
    if changed == files[member]:
        return False
    files[member] = changed
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return True


def change_sheet(path):
    book = openpyxl.load_workbook(path)
    book.active["A2"] = "=1+1"
    book.save(path)
    return True


def cut(path):
    path.write_bytes(path.read_bytes()[:-100])
    return True


def change_crs(path):
    content = path.read_bytes()
    path.write_bytes(content.replace((3857).to_bytes(4, "little"), (3395).to_bytes(4, "little"), 1))
    return True


def drop_layer(path):
    with sqlite3.connect(path) as database:
        for table in ("gpkg_geometry_columns", "gpkg_contents"):
            database.execute(f"DELETE FROM {table} WHERE table_name = 'faces'")
    return True


def faults():
    """What is broken, the step that finds it, the file, and the way to break it."""
    for step, name, old, new in TEXTS:
        yield f"{name}: {new!r}", step, name, lambda path, old=old, new=new: change_text(path, old, new)
    for step, name, member, old, new in MEMBERS:
        break_it = lambda path, member=member, old=old, new=new: change_member(path, member, old, new)
        yield f"{name}: {member}: {new!r}", step, name, break_it
    yield "locations.xlsx: a formula", "tables", "locations.xlsx", change_sheet
    yield "faces.fgb: its end is missing", "flatgeobuf", "faces.fgb", cut
    yield "faces.fgb: another system", "flatgeobuf", "faces.fgb", change_crs
    yield "map.gpkg: a layer is missing", "geopackage", "map.gpkg", drop_layer
    yield "bundle.zip: its end is missing", "bundle", "bundle.zip", cut


def prove(folder, kinds):
    """Breaks a copy of the exports in every way; exits with an error where nothing is found."""
    missed = []
    for what, step, name, break_it in faults():
        with tempfile.TemporaryDirectory() as temporary:
            copy = Path(shutil.copytree(folder, Path(temporary) / "exports"))
            if not break_it(copy / name):
                missed.append(f"{what}: there is nothing to break")
                continue
            found = validate.problems_of(getattr(validate, step), copy, kinds)
            print(f"{what}\n    {found[0] if found else 'NOT FOUND'}")
            if not found:
                missed.append(f"{what}: is not found by {step}")
    if missed:
        sys.exit("\n".join(missed))
