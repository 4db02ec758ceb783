//! Names of the materials of a case, by the `name` of their layer or of the substrate.

/// Names of all materials that differ, from the `name` of each layer from the surface down and of the substrate. One that
/// several share has their number behind it: "TiN, layer 3".
pub(super) fn distinct(names: &[Option<&str>]) -> Vec<Option<String>> {
    let label = |(index, name): (usize, &Option<&str>)| {
        let name = (*name)?;
        Some(match names.iter().filter(|listed| **listed == Some(name)).count() {
            1 => name.to_owned(),
            _ if index + 1 == names.len() => format!("{name}, substrate"),
            _ => format!("{name}, layer {}", index + 1),
        })
    };
    names.iter().enumerate().map(label).collect()
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, Source, embedded};

    fn case(settings: &[&str]) -> Case {
        let settings: Vec<String> = settings.iter().map(|&text| text.to_owned()).collect();
        Case::read(&nameless(), &settings).unwrap_or_else(|error| panic!("{error}"))
    }

    fn nameless() -> Source {
        let source = embedded::source("dlc-on-steel").unwrap();
        let lines = source.text.lines().filter(|line| !line.starts_with("name = "));
        Source { text: lines.collect::<Vec<_>>().join("\n"), ..source }
    }

    fn named(settings: &[&str]) -> Vec<String> {
        let case = case(settings);
        let half_space = case.half_space();
        (1..=half_space.materials().count()).map(|number| half_space.material_id(number).to_string()).collect()
    }

    #[test]
    fn materials_have_the_names_of_the_case_or_their_numbers() {
        let names = ["layers.0.name=DLC", "substrate.name=\"steel 100Cr6\""];
        assert_eq!(named(&names), ["DLC", "material 2", "steel 100Cr6"]);
        let case = case(&names);
        let interfaces = [1, 2].map(|number| case.half_space().interface_id(number).to_string());
        assert_eq!(interfaces, ["DLC/material 2", "material 2/steel 100Cr6"]);
    }

    #[test]
    fn a_name_that_several_share_has_their_number() {
        let names = ["layers.0.name=TiN", "layers.1.name=Ti", "substrate.name=TiN"];
        assert_eq!(named(&names), ["TiN, layer 1", "Ti", "TiN, substrate"]);
    }

    #[test]
    fn sublayers_of_a_graded_layer_share_its_name() {
        let graded = "layers.1.graded={ young = [2, 1], poisson = [0.2, 0.3], sublayers = 2 }";
        let names = ["layers.1.name=\"graded Cr\"", graded];
        let sublayers = ["graded Cr, sublayer 1 of 2", "graded Cr, sublayer 2 of 2"];
        assert_eq!(named(&names), ["material 1", sublayers[0], sublayers[1], "material 4"]);
    }

    #[test]
    fn a_name_is_written_and_read_again_and_no_blank_one_is_admitted() {
        let case = case(&["layers.0.name=TiN", "layers.1.name=TiN"]);
        assert_eq!(case.to_toml().matches("name = \"TiN\"").count(), 2);
        let source = nameless();
        for name in ["\"\"", "\" \"", "\" TiN\"", "\"a\\tb\"", "7", &format!("\"{}\"", "m".repeat(41))] {
            let error = Case::read(&source, &[format!("substrate.name={name}")]).unwrap_err();
            assert!(error.message().starts_with("`substrate.name` must be a name of 1 to 40 characters"), "{error}");
        }
    }
}
