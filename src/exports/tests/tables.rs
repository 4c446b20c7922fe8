//! Exports that are tables, and the graph for tools.

use expect_test::expect;
use stillage_core::layout::Layout;

use super::Site;
use crate::exports::locations_csv::{Profile, locations};
use crate::exports::{ExportSource, InventoryOptions, graph_ml, locations_xlsx};

#[test]
fn every_inventory_system_has_its_columns() {
    let source = Site::small().source();
    let table = |profile: Profile| {
        let bytes = locations(&source, profile, &InventoryOptions::default());
        let text = String::from_utf8(bytes).unwrap();
        format!("{}\n{}", profile.name(), text.lines().take(3).map(|line| format!("{line}\n")).collect::<String>())
    };
    expect![[r#"
        generic
        code,label,aisle,bay,side,row,depthInRow,x,y,widthM,depthM,areaM2,headingDeg,occupancy,occupancyConfidence,approachX,approachY,approachHeadingDeg,node
        01-001,pallet cell,1,1,left,1,1,5.8635,18.9532,16.0,2.0,32.0,107.1887,occupied,0.988,6.3363,17.4247,107.1887,01-001
        01-002,pallet cell,1,2,right,2,1,7.3411,14.1765,16.0,2.0,32.0,-72.8112,occupied,0.988,6.8682,15.705,-72.8112,01-002
        odoo
        name,location_id,usage,barcode,posx,posy,posz
        01-001,WH,internal,01-001,1,1,0
        01-002,WH,internal,01-002,1,2,0
        sap-ewm
        LGNUM,LGTYP,LGPLA,AISLE,STACK,LVL_V,X_CORD,Y_CORD,Z_CORD,DEPTH
        WH,BULK,01-001,1,1,0,5.8635,18.9532,0,1
        WH,BULK,01-002,1,2,0,7.3411,14.1765,0,1
        business-central
        Location Code,Code,Description,Zone Code
        WH,01-001,pallet cell,BULK
        WH,01-002,pallet cell,BULK
    "#]].assert_eq(&Profile::ALL.map(table).concat());
}

#[test]
fn no_code_becomes_a_formula() {
    let mut layout: Layout = Site::small().layout.clone();
    layout.locations[0].code = "=1+1".to_owned();
    let source = ExportSource { layout: &layout, ..Site::small().source() };
    for profile in Profile::ALL {
        let text = String::from_utf8(locations(&source, profile, &InventoryOptions::default())).unwrap();
        assert!(text.contains("'=1+1") && !text.contains(",=1+1") && !text.contains("\n=1+1"), "{text}");
    }
}

#[test]
fn the_same_version_gives_the_same_workbook() {
    let source = Site::small().source();
    let first = locations_xlsx::locations(&source).unwrap();
    assert_eq!(first, locations_xlsx::locations(&source).unwrap());
    assert!(first.starts_with(b"PK"));
}

#[test]
fn a_graph_is_xml() {
    let text = String::from_utf8(graph_ml::graph(&Site::small().source())).unwrap();
    expect![[r#"
        <?xml version="1.0" encoding="UTF-8"?>
        <graphml xmlns="http://graphml.graphdrawing.org/xmlns">
          <key id="x" for="node" attr.name="x" attr.type="double"/>
          <key id="y" for="node" attr.name="y" attr.type="double"/>
          <key id="kind" for="node" attr.name="kind" attr.type="string"/>
          <key id="location" for="node" attr.name="location" attr.type="string"/>
          <key id="heading" for="node" attr.name="heading" attr.type="double"/>
          <key id="clearance" for="node" attr.name="clearance" attr.type="double"/>
          <key id="length" for="edge" attr.name="length" attr.type="double"/>
          <key id="width" for="edge" attr.name="width" attr.type="double"/>
          <key id="label" for="edge" attr.name="label" attr.type="string"/>
          <key id="name" for="graph" attr.name="name" attr.type="string"/>
          <graph id="hall" edgedefault="directed">
            <data key="name">Hall</data>
            <node id="N0001"><data key="x">-1.0404</data><data key="y">14.2007</data><data key="kind">junction</data><data key="clearance">1</data></node>
            <node id="N0002"><data key="x">14.245</data><data key="y">18.929</data><data key="kind">dead-end</data><data key="clearance">1</data></node>
            <node id="01-001"><data key="x">6.3363</data><data key="y">17.4247</data><data key="kind">approach</data><data key="clearance">1</data><data key="location">01-001</data><data key="heading">1.870796</data></node>
            <node id="01-002"><data key="x">6.8682</data><data key="y">15.705</data><data key="kind">approach</data><data key="clearance">1</data><data key="location">01-002</data><data key="heading">-1.270796</data></node>
            <edge source="N0001" target="N0002"><data key="length">16.0078</data><data key="width">2.5</data><data key="label">co</data></edge>
            <edge source="N0001" target="01-001"><data key="length">8.0505</data><data key="width">2.5</data><data key="label">co</data></edge>
            <edge source="N0001" target="01-002"><data key="length">8.0505</data><data key="width">2.5</data><data key="label">co</data></edge>
            <edge source="N0002" target="N0001"><data key="length">16.0078</data><data key="width">2.5</data><data key="label">co</data></edge>
            <edge source="01-001" target="N0001"><data key="length">8.0505</data><data key="width">2.5</data><data key="label">co</data></edge>
            <edge source="01-002" target="N0001"><data key="length">8.0505</data><data key="width">2.5</data><data key="label">co</data></edge>
          </graph>
        </graphml>
    "#]].assert_eq(&text);
}
