"""What clients make of a map: check.py MAP_URL SCHEMAS WORK_FOLDER. A line for each check; the first that fails ends it."""

import json
import pathlib
import subprocess
import sys
import time
import urllib.parse
import urllib.request

import jsonschema
import openapi_spec_validator
import pyogrio
from owslib.ogcapi.features import Features
from owslib.ogcapi.processes import Processes


MAP, SCHEMAS, WORK = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
SERVICE = MAP.split("/v1/")[0]
SOURCE = f"OAPIF:{MAP}"


def get(path):
    """A JSON document of the service."""
    with urllib.request.urlopen(path) as answer:
        return json.load(answer)


COLLECTIONS = [collection["id"] for collection in get(f"{MAP}/collections")["collections"]]
FACES = get(f"{MAP}/collections/faces/items?limit=10000")["features"]
CORRIDORS = [face["id"] for face in FACES if face["properties"]["label"] == "co"]


def run(*command):
    """The output of a program that has to succeed."""
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


def documents_are_valid():
    """openapi-spec-validator: the three OpenAPI documents."""
    for path in (f"{SERVICE}/openapi.json", f"{SERVICE}/openapi-3.0.json", f"{MAP}/api"):
        openapi_spec_validator.validate(get(path))


def json_fg_is_valid():
    """The official schema of JSON-FG 1.0: a page of each collection, and a feature."""
    def validate(name, document):
        schema = json.loads((SCHEMAS / "json-fg-1.0" / name).read_text())
        jsonschema.Draft202012Validator(schema).validate(document)

    for collection in COLLECTIONS:
        for query in ("f=jsonfg", "profile=jsonfg"):
            page = get(f"{MAP}/collections/{collection}/items?{query}&limit=100")
            for name in ("featurecollection.min.json", "jsonfg-root-object.min.json"):
                validate(name, page)
    validate("feature.min.json", get(f"{MAP}/collections/faces/items/{FACES[0]['id']}?f=jsonfg"))


def system_gdal_reads_and_converts():
    """ogrinfo and ogr2ogr of the system: count, fields, one feature, a selection, a copy as GeoPackage."""
    summary = run("ogrinfo", "-ro", "-so", SOURCE, "faces")
    assert f"Feature Count: {len(FACES)}" in summary and "areaM2: Real" in summary, summary
    found = FACES[-1]["id"]
    one = run("ogrinfo", "-ro", "-q", "-fid", str(found), SOURCE, "faces")
    assert f"id (Integer) = {found}" in one, one
    selected = run("ogrinfo", "-ro", "-q", "-geom=NO", "-where", "label='co'", SOURCE, "faces")
    assert selected.count("OGRFeature(faces)") == len(CORRIDORS), selected
    copy = WORK / "faces.gpkg"
    run("ogr2ogr", "-f", "GPKG", str(copy), SOURCE, "faces")
    assert f"Feature Count: {len(FACES)}" in run("ogrinfo", "-ro", "-so", str(copy), "faces")


def read_through_relay(where):
    """What GDAL of today reads with a selection, and what it asked for: shapes, bytes, requests."""
    service = urllib.parse.urlsplit(SERVICE)
    command = [sys.executable, str(pathlib.Path(__file__).with_name("counting.py")), service.hostname, str(service.port)]
    relay = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    source = SOURCE.replace(service.netloc, f"127.0.0.1:{relay.stdout.readline().strip()}")
    _, _, shapes, _ = pyogrio.raw.read(source, layer="faces", where=where)
    counted = json.loads(relay.communicate()[0])
    return len(shapes), counted["bytes"], [request for request in counted["requests"] if "/items?" in request]


def todays_gdal_leaves_selections_to_the_service():
    """GDAL of today: a selection is made by the service, not after everything was downloaded."""
    wanted = [face for face in FACES if face["properties"]["label"] == "co" and face["properties"]["areaM2"] > 50]
    count, some_bytes, requests = read_through_relay("label = 'co' AND areaM2 > 50")
    assert count == len(wanted) > 0, (count, len(wanted))
    assert any("filter=" in request for request in requests), requests
    count, all_bytes, _ = read_through_relay(None)
    assert count == len(FACES) and some_bytes < all_bytes, (some_bytes, all_bytes)


def files_are_read():
    """GDAL of today: each format of a whole collection has every feature in metres of the map."""
    metres = get(f"{MAP}/collections/faces/items?crs=EPSG:3857&limit=10000")["features"]
    west = min(position[0] for face in metres for ring in face["geometry"]["coordinates"] for position in ring)
    for name, driver in (("fgb", ""), ("csv", ""), ("jsonfg", "JSONFG:")):
        path = WORK / f"faces.{'fg.json' if name == 'jsonfg' else name}"
        urllib.request.urlretrieve(f"{MAP}/collections/faces/items?f={name}&crs=EPSG:3857&limit=10000", path)
        options = {"GEOM_POSSIBLE_NAMES": "geometry"} if name == "csv" else {}
        info = pyogrio.read_info(f"{driver}{path}", force_total_bounds=True, force_feature_count=True, **options)
        assert info["features"] == len(FACES), (name, info)
        assert abs(info["total_bounds"][0] - west) < 1e-3, (name, info)


def the_whole_map_is_one_file():
    """GDAL of today: the enclosure of the map is a GeoPackage with every collection, in metres of the map."""
    [link] = [link for link in get(MAP)["links"] if link["rel"] == "enclosure"]
    path = WORK / "map.gpkg"
    urllib.request.urlretrieve(link["href"], path)
    assert sorted(name for name, _ in pyogrio.list_layers(path)) == sorted(COLLECTIONS)
    for collection in COLLECTIONS:
        info = pyogrio.read_info(path, layer=collection, force_feature_count=True)
        count = get(f"{MAP}/collections/{collection}/items?limit=1")["numberMatched"]
        assert info["crs"] == "EPSG:3857" and info["features"] == count, (collection, info)


def todays_gdal_reads_metres():
    """GDAL of today: system, number and place of the faces, and a selection."""
    info = pyogrio.read_info(SOURCE, layer="faces", force_total_bounds=True)
    assert info["crs"] == "EPSG:3857" and info["features"] == len(FACES), info
    metres = get(f"{MAP}/collections/faces/items?crs=EPSG:3857&limit=10000")["features"]
    points = [position for face in metres for ring in face["geometry"]["coordinates"] for position in ring]
    bounds = [side(point[axis] for point in points) for side in (min, max) for axis in (0, 1)]
    assert all(abs(one - other) < 1e-3 for one, other in zip(info["total_bounds"], bounds)), (info, bounds)
    _, _, shapes, _ = pyogrio.raw.read(SOURCE, layer="faces", where="label='co'")
    assert len(shapes) == len(CORRIDORS)


def owslib_reads():
    """OWSLib: conformance, collections, queryables, schema, a page in a box, a filter, a feature, the API's definition."""
    client = Features(f"{MAP}/")
    assert any(uri.endswith("ogcapi-features-1/1.0/conf/core") for uri in client.conformance()["conformsTo"])
    assert client.feature_collections() == COLLECTIONS
    page = client.collection_items("faces", limit=3, bbox=["-180", "-90", "180", "90"])
    assert (page["numberMatched"], page["numberReturned"]) == (len(FACES), 3)
    for properties in (client.collection_queryables("faces"), client.collection_schema("faces")):
        assert "areaM2" in properties["properties"], properties
    assert client.collection_items("faces", filter="label='co'")["numberMatched"] == len(CORRIDORS)
    assert client.collection_item("faces", str(FACES[0]["id"]))["id"] == FACES[0]["id"]
    assert client.api()["openapi"] == "3.0.3"


def owslib_executes():
    """OWSLib: processes, a description, an execution that waits, one that does not, and its results."""
    client = Processes(f"{SERVICE}/v1/")
    assert any(uri.endswith("ogcapi-common-1/1.0/conf/core") for uri in client.conformance()["conformsTo"])
    assert [process["id"] for process in client.processes()] == ["semantic-map"]
    assert "mapId" in client.process("semantic-map")["inputs"]
    inputs = {"mapId": MAP.rsplit("/", 1)[1]}
    assert client.execute("semantic-map", inputs)["faces"]["href"] == f"{MAP}/collections/faces/items"
    job = client.execute("semantic-map", inputs | {"options": {"seed": 7}}, async_=True)["jobID"]
    while get(f"{SERVICE}/v1/jobs/{job}")["status"] in ("accepted", "running"):
        time.sleep(0.2)
    results = get(f"{SERVICE}/v1/jobs/{job}/results")
    assert results["map"]["href"] == MAP
    proposal = get(results["analysis"]["href"])
    assert proposal["inForce"] is False and proposal["options"]["seed"] == 7, proposal
    assert job in [one["jobID"] for one in get(f"{SERVICE}/v1/jobs?status=successful&minDuration=0")["jobs"]]


def a_surveyed_map_is_in_its_zone():
    """GDAL of today: a map that is surveyed is in metres of its zone of UTM, where it lies on Earth."""
    place = json.dumps({"georeference": {"lon": 12.8572, "lat": 56.6745, "heading": 30}}).encode()
    headers = {"Content-Type": "application/merge-patch+json"}
    urllib.request.urlopen(urllib.request.Request(MAP, place, headers, method="PATCH")).close()
    info = pyogrio.read_info(SOURCE, layer="faces", force_total_bounds=True)
    assert info["crs"] == "EPSG:32633" and info["features"] == len(FACES), info
    west, south, east, north = info["total_bounds"]
    # Where PROJ puts the origin of the map frame, which lies amid the hall.
    assert west < 368_707.2 < east < west + 80 and south < 6_283_205.5 < north < south + 80, info


print(f"GDAL {'.'.join(map(str, pyogrio.__gdal_version__))}, {run('ogrinfo', '--version').strip()}")
for check in (
    documents_are_valid,
    json_fg_is_valid,
    system_gdal_reads_and_converts,
    todays_gdal_reads_metres,
    todays_gdal_leaves_selections_to_the_service,
    files_are_read,
    the_whole_map_is_one_file,
    owslib_reads,
    owslib_executes,
    a_surveyed_map_is_in_its_zone,
):
    check()
    print(f"ok: {check.__doc__}")
