#[test]
fn dump() {
    let o = (percoat::validation::find("discretisation").unwrap().run)().unwrap();
    for c in &o.checks {
        println!("{} {:.3} {:.3} {}", c.quantity, c.value, c.reference, c.verdict());
    }
    for r in &o.data[0].rows {
        if r[4] > r[3] {
            println!("FAIL {r:?} ratio {:.2}", r[4] / r[3]);
        }
    }
}
