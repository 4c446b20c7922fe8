"""What QGIS makes of a map, without a screen: qgis_layer.py MAP_URL. Run by the Python of the system, which has QGIS.

Reading: a valid layer, its number of features, a selection. Writing: QGIS sends changes of attributes with the transaction
support of its OGC API provider where the version has it: 3.32 and later (github.com/qgis/QGIS/pull/52504); older ones, as the
3.22 of Debian 12, open the layer for reading only."""

import os
import sys

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from qgis.core import Qgis, QgsApplication, QgsVectorDataProvider, QgsVectorLayer

application = QgsApplication([], False)
application.initQgis()
print(f"QGIS {Qgis.QGIS_VERSION}")

layer = QgsVectorLayer(f"url='{sys.argv[1]}' typename='faces' pagingEnabled='true'", "faces", "OAPIF")
assert layer.isValid(), layer.error().message()
labels = [feature["label"] for feature in layer.getFeatures()]
assert len(labels) == 220 and layer.featureCount() == 220, (len(labels), layer.featureCount())
assert {"label", "areaM2", "category"} <= {field.name() for field in layer.fields()}

assert layer.setSubsetString("label = 'co'")
corridors = list(layer.getFeatures())
assert len(corridors) == labels.count("co") == 5, len(corridors)
print("ok: layer, count, fields, subset")

if layer.dataProvider().capabilities() & QgsVectorDataProvider.ChangeAttributeValues:
    with_label = layer.fields().indexOf("label")
    assert layer.startEditing() and layer.changeAttributeValue(corridors[0].id(), with_label, "ju")
    assert layer.commitChanges(), layer.commitErrors()
    assert len(list(layer.getFeatures())) == 4
    print("ok: a label is changed")
else:
    print("this version of QGIS writes to no OGC API")
