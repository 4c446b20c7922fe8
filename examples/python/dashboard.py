"""A dashboard: uploads a map, shows how its analysis proceeds, counts faces by label, and decides about a category.

    python dashboard.py http://127.0.0.1:8080 IMAGE METADATA
"""

import collections
import json
import pathlib
import sys

import requests


def ask(method, address, **parts):
    """The answer to a request; where the service refuses it, the program ends with the reason."""
    answer = requests.request(method, address, timeout=60, **parts)
    if not answer.ok:
        sys.exit(answer.json()["detail"])
    return answer


def progress(job_url):
    """The states of a job as they come, up to the final one: server-sent events."""
    with ask("GET", f"{job_url}/events", stream=True) as events:
        for line in events.iter_lines(decode_unicode=True):
            if line.startswith("data:"):
                yield json.loads(line.removeprefix("data:"))


def faces_by_label(map_url):
    """How many faces each label has, in a line."""
    faces = ask("GET", f"{map_url}/collections/faces/items", params={"limit": 10_000}).json()["features"]
    counts = collections.Counter(face["properties"]["labelName"] for face in faces)
    return ", ".join(f"{count} {label}" for label, count in counts.most_common())


service_url, image, metadata = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])

with image.open("rb") as picture, metadata.open("rb") as yaml:
    parts = {"image": picture, "metadata": yaml}
    upload = ask("POST", f"{service_url}/v1/maps", files=parts, data={"name": image.stem})
for job in progress(f"{service_url}{upload.headers['Location']}"):
    print(f"{job['progress']:3} % {job['status']} {job.get('stage', '')}")
if job["status"] != "successful":
    sys.exit(job["message"])
map_url = f"{service_url}/v1/maps/{job['mapId']}"
print(faces_by_label(map_url))

# A person decides: the largest category that no label fits is a corridor. If somebody else changed the labels since they
# were read, If-Match has the change refused (412).
categories = ask("GET", f"{map_url}/categories").json()["categories"]
open_ones = [category for category in categories if category["kind"] == "cluster" and category["label"] == "un"]
chosen = max(open_ones, key=lambda category: category["areaM2"])
before = ask("GET", f"{map_url}/semantics")
after = ask(
    "PATCH",
    f"{map_url}/semantics",
    json={"assignment": {str(chosen["id"]): "co"}},
    headers={"If-Match": before.headers["ETag"], "Content-Type": "application/merge-patch+json"},
)
print(f"Category {chosen['id']} is a corridor in version {after.json()['version']} of the labels")
print(faces_by_label(map_url))
