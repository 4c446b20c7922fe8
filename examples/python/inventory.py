"""An inventory system: the storage locations of a map as a table, and what has changed about them.

    python inventory.py http://127.0.0.1:8080/v1/maps/MAP [SINCE]

SINCE is the version of the labels that the inventory system knows: 0, the suggestion, when absent.
"""

import sys

import requests

COLUMNS = ("code", "aisle", "bay", "side", "widthM", "depthM", "occupancy")


def get(address, **parameters):
    """The answer to a question; where the service refuses it, the program ends with the reason."""
    answer = requests.get(address, params=parameters, timeout=30)
    if not answer.ok:
        sys.exit(answer.json()["detail"])
    return answer


def locations(map_url):
    """All storage locations, page by page, with coordinates in metres of the map."""
    page = f"{map_url}/collections/locations/items?limit=100&crs=EPSG:3857"
    while page:
        answer = get(page)
        yield from answer.json()["features"]
        page = answer.links.get("next", {}).get("url")


def print_table(rows):
    """Rows in columns, each as wide as its widest value."""
    rows = [[str(value) for value in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        print("  ".join(value.ljust(width) for value, width in zip(row, widths)).rstrip())


map_url = sys.argv[1]
since = sys.argv[2] if len(sys.argv) > 2 else "0"

found = [location["properties"] for location in locations(map_url)]
print_table([COLUMNS, *([location[name] for name in COLUMNS] for location in found)])
empty = sum(location["occupancy"] == "empty" for location in found)
print(f"\n{len(found)} locations, {empty} of them empty")

changes = get(f"{map_url}/changes", since=since).json()
print(f"Since version {changes['since']} of the labels (now version {changes['version']}):")
for kind in ("added", "removed", "changed"):
    codes = [location["code"] for location in changes["locations"][kind]]
    print(f"  {len(codes)} {kind}", *codes)
