//! Channels of a file: which one is read.

use super::fault::Fault;
use super::header::HeightsUnit;
use percoat_common::plain;
use serde::Serialize;

/// The channel of a file that is wanted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum WantedChannel {
    /// Name of the channel.
    Named(String),
    /// Number of the channel, from 1.
    Number(usize),
}

/// A channel of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Channel {
    /// Name; empty for one without.
    pub name: String,
    /// Unit of its values; none where the file has none.
    pub unit: Option<HeightsUnit>,
}

/// Most channels that a message lists.
const LISTED: usize = 20;
/// Most characters of a name in a message.
const LONGEST: usize = 60;

impl Channel {
    /// Whether its values are lengths.
    fn is_of_heights(&self) -> bool {
        matches!(self.unit, Some(HeightsUnit::Known(_)))
    }

    /// Words for the channel in a message: its number, name and unit.
    fn described(&self, number: usize) -> String {
        let name: String = plain::line(&self.name).chars().take(LONGEST).collect();
        let name = if name.is_empty() { String::new() } else { format!(" \"{name}\"") };
        match &self.unit {
            Some(HeightsUnit::Known(unit)) => format!("{number}{name} in {unit}"),
            Some(HeightsUnit::Other) => format!("{number}{name}, no length"),
            None => format!("{number}{name} without a unit"),
        }
    }
}

/// Index of the channel that is wanted, or of the only one with heights.
pub fn choose(channels: &[Channel], wanted: Option<&WantedChannel>) -> Result<usize, Fault> {
    let listed = || {
        let all = (1..).zip(channels).take(LISTED).map(|(number, channel)| channel.described(number));
        let more = if channels.len() > LISTED { "; …" } else { "" };
        format!("{}{more}", all.collect::<Vec<_>>().join("; "))
    };
    let refused = |what: String, label: &str| {
        let help = format!("its channels are: {}; give surface.channel, a name or a number of these", listed());
        Fault::new(what, label).help(help)
    };
    let only =
        |is: &dyn Fn(&Channel) -> bool| -> Vec<usize> { (0..channels.len()).filter(|k| is(&channels[*k])).collect() };
    match wanted {
        Some(WantedChannel::Number(number)) => match number.checked_sub(1).filter(|index| *index < channels.len()) {
            Some(index) => Ok(index),
            None => Err(refused(format!("has no channel {number}"), "which channel?")),
        },
        Some(WantedChannel::Named(name)) => match only(&|channel| channel.name == *name)[..] {
            [index] => Ok(index),
            [] => Err(refused("has no channel of the name surface.channel".to_owned(), "which channel?")),
            _ => Err(refused("has several channels of the name surface.channel".to_owned(), "which channel?")),
        },
        None => match (&only(&Channel::is_of_heights)[..], channels.len()) {
            ([index], _) => Ok(*index),
            (_, 1) => Ok(0),
            ([], _) => Err(refused("has several channels and none in a unit of length".to_owned(), "which channel?")),
            _ => Err(refused("has several channels of heights".to_owned(), "which channel?")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_only_channel_of_heights_is_read_and_of_several_the_one_that_is_wanted() {
        let channel = |name: &str, unit: Option<&str>| Channel {
            name: name.to_owned(),
            unit: unit.map(|unit| if unit == "V" { HeightsUnit::Other } else { HeightsUnit::Known(unit.to_owned()) }),
        };
        let one = [channel("Error", Some("V")), channel("Height", Some("m")), channel("Phase", Some("V"))];
        assert_eq!(choose(&one, None), Ok(1));
        assert_eq!(choose(&one[..1], None), Ok(0));
        let named = |name: &str| Some(WantedChannel::Named(name.to_owned()));
        assert_eq!(choose(&one, named("Phase").as_ref()), Ok(2));
        let two = [channel("Height", Some("m")), channel("Back", Some("nm")), channel("", None)];
        assert_eq!(choose(&two, Some(&WantedChannel::Number(2))), Ok(1));
        for wanted in [None, named("Nothing"), Some(WantedChannel::Number(4)), Some(WantedChannel::Number(0))] {
            let help = choose(&two, wanted.as_ref()).unwrap_err().help.unwrap();
            assert!(help.contains("1 \"Height\" in m; 2 \"Back\" in nm; 3 without a unit"), "{help}");
        }
        assert!(choose(&[one[0].clone(), one[2].clone()], None).is_err());
        assert!(choose(&[one[1].clone(), one[1].clone()], named("Height").as_ref()).is_err());
    }
}
