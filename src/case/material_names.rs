use super::{LayerSection, SubstrateSection};

/// Names of the materials of a body: one a homogeneous layer from the surface down, sublayers counted, then the substrate's.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MaterialNames(Vec<Option<String>>);

impl MaterialNames {
    pub(super) fn of(layers: &[LayerSection], substrate: &SubstrateSection) -> Self {
        let sublayers = layers.iter().flat_map(|layer| {
            let count = layer.sublayers();
            (1..=count).map(move |number| match &layer.name {
                Some(name) if count > 1 => Some(format!("{name}, sublayer {number} of {count}")),
                name => name.clone(),
            })
        });
        Self(sublayers.chain([substrate.name.clone()]).collect())
    }

    /// The name of material `number`, from 1, in the case; `None` without one.
    pub fn given(&self, number: usize) -> Option<&str> {
        self.0.get(number.checked_sub(1)?)?.as_deref()
    }

    /// The name of material `number`, from 1: "TiN", or "material 2" where the case has no name for it.
    pub fn name(&self, number: usize) -> String {
        self.given(number).map_or_else(|| format!("material {number}"), str::to_owned)
    }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, embedded};

    fn case(settings: &[&str]) -> Case {
        let settings: Vec<String> = settings.iter().map(|&text| text.to_owned()).collect();
        Case::read(&embedded::source("dlc-on-steel").unwrap(), &settings).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn materials_have_the_names_of_the_case_or_their_numbers() {
        let names = case(&["layers.0.name=DLC", "substrate.name=\"steel 100Cr6\""]).material_names();
        assert_eq!([1, 2, 3, 4].map(|number| names.name(number)), ["DLC", "material 2", "steel 100Cr6", "material 4"]);
        assert_eq!((names.given(1), names.given(2), names.given(0)), (Some("DLC"), None, None));
    }

    #[test]
    fn sublayers_of_a_graded_layer_share_its_name() {
        let graded = "layers.1.graded={ young = [2, 1], poisson = [0.2, 0.3], sublayers = 2 }";
        let names = case(&["layers.1.name=\"graded Cr\"", graded]).material_names();
        assert_eq!(names.name(3), "graded Cr, sublayer 2 of 2");
    }

    #[test]
    fn a_name_is_written_and_read_again_and_no_blank_one_is_admitted() {
        let own = case(&["layers.0.name=TiN", "layers.1.name=TiN"]);
        assert_eq!(own.to_toml().matches("name = \"TiN\"").count(), 2);
        let source = embedded::source("dlc-on-steel").unwrap();
        for name in ["\"\"", "\" \"", "\" TiN\"", "\"a\\tb\"", "7", &format!("\"{}\"", "m".repeat(41))] {
            let error = Case::read(&source, &[format!("substrate.name={name}")]).unwrap_err();
            assert!(error.message().starts_with("`substrate.name` must be a name of 1 to 40 characters"), "{error}");
        }
    }
}
