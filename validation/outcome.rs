//! A study, and its outcome: checks, figures and data.

use super::check::Check;
use super::paper::Claim;
use percoat_app::picture::Figure;

/// The error of a study that could not be completed.
pub type StudyError = Box<dyn std::error::Error + Send + Sync>;

/// One study.
#[derive(Debug, Clone, Copy)]
pub struct Study {
    /// Name on the command line and of the folder in `validation/`.
    pub name: &'static str,
    /// Summary, in one line.
    pub title: &'static str,
    /// Files that it writes into its folder: figures, data and published data.
    pub files: &'static [&'static str],
    /// The whole study.
    pub run: fn() -> Result<Outcome, StudyError>,
    /// A quick form with fewer points; each of its checks is one of the whole study, with its name, tolerance and verdict. `None` where
    /// the whole study is quick.
    pub quick: Option<fn() -> Result<Outcome, StudyError>>,
}

/// The outcome of a study.
#[derive(Debug, Clone, Default)]
pub struct Outcome {
    /// The comparisons, in the order of the report.
    pub checks: Vec<Check>,
    /// Figures by the name of their file, without its ending; the first one shows the agreement.
    pub figures: Vec<(&'static str, Figure)>,
    /// Tables of all computed values.
    pub data: Vec<Data>,
    /// The curves of published figures, written as `<name>.csv`.
    pub published: Vec<Data>,
    /// Statements of the paper with their verdicts, see [`Self::judge`].
    pub claims: Vec<Claim>,
}

impl Outcome {
    /// Adds statements of the paper, and the checks of each.
    pub fn judge(&mut self, claims: impl IntoIterator<Item = Claim>) {
        for claim in claims {
            self.checks.extend(claim.checks());
            self.claims.push(claim);
        }
    }

    /// Tables by the names of their files, published ones rounded.
    pub fn tables(&self) -> impl Iterator<Item = (String, Data)> {
        let data = self.data.iter().map(|data| (format!("{}.data.csv", data.name), data.clone()));
        data.chain(self.published.iter().map(|data| (format!("{}.csv", data.name), data.rounded())))
    }

    /// Names of all files, sorted.
    pub fn files(&self) -> Vec<String> {
        let figures = self.figures.iter().map(|(name, _)| format!("{name}.png"));
        let mut files: Vec<String> = figures.chain(self.tables().map(|(name, _)| name)).collect();
        files.sort();
        files
    }

    /// Whether there is a check and all of them hold.
    pub fn holds(&self) -> bool {
        !self.checks.is_empty() && self.checks.iter().all(Check::holds)
    }
}

/// A table of numbers, written as `<name>.data.csv`.
#[derive(Debug, Clone, PartialEq)]
pub struct Data {
    /// Name of the file, without its ending.
    pub name: &'static str,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// One value a column.
    pub rows: Vec<Vec<f64>>,
}

impl Data {
    /// A table without rows.
    pub fn new(name: &'static str, columns: &[&str]) -> Self {
        Self { name, columns: columns.iter().map(|&column| column.to_owned()).collect(), rows: Vec::new() }
    }

    /// The table as CSV, every number with all its digits.
    pub fn csv(&self) -> String {
        let mut text = self.columns.join(",") + "\n";
        for row in &self.rows {
            text += &(row.iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n");
        }
        text
    }

    /// The table with six significant digits.
    #[must_use]
    pub fn rounded(&self) -> Self {
        let round = |x: &f64| format!("{x:.5e}").parse().unwrap_or(*x);
        Self { rows: self.rows.iter().map(|row| row.iter().map(round).collect()).collect(), ..self.clone() }
    }

    /// The values of a column; none where there is no such column.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let index = self.columns.iter().position(|column| column == name);
        index.map_or(Vec::new(), |index| self.rows.iter().map(|row| row[index]).collect())
    }

    /// Reads a CSV table of the form of [`Self::csv`]; lines that begin with `#` are comments on its source.
    ///
    /// # Errors
    /// The first cell that is not a number, or row of another length, with its line.
    pub fn parse(name: &'static str, text: &str) -> Result<Self, String> {
        let mut lines = (1..).zip(text.lines()).filter(|(_, line): &(usize, &str)| !line.starts_with('#'));
        let header = lines.next().map_or("", |(_, line)| line);
        let mut data = Self::new(name, &header.split(',').collect::<Vec<_>>());
        for (number, line) in lines {
            let row: Result<Vec<f64>, _> = line.split(',').map(str::parse).collect();
            let row = row.map_err(|error| format!("{name}, line {number}: {error}"))?;
            if row.len() != data.columns.len() {
                return Err(format!("{name}, line {number}: {} values for {} columns", row.len(), data.columns.len()));
            }
            data.rows.push(row);
        }
        Ok(data)
    }

    /// Reads a CSV table in which the number of one of these `names` stands for each cell that is one.
    ///
    /// # Errors
    /// The errors of [`Self::parse`].
    pub fn parse_named(name: &'static str, text: &str, names: &[&str]) -> Result<Self, String> {
        let number = |cell: &str| names.iter().position(|name| *name == cell).map(|number| number.to_string());
        let mut lines = text.lines();
        let header = lines.by_ref().find(|line| !line.starts_with('#')).unwrap_or_default().to_owned();
        let row = |line: &str| {
            line.split(',').map(|cell| number(cell).unwrap_or(cell.to_owned())).collect::<Vec<_>>().join(",")
        };
        Self::parse(name, &[header].into_iter().chain(lines.map(row)).collect::<Vec<_>>().join("\n"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_survives_csv_and_broken_ones_are_refused() {
        let mut data = Data::new("x", &["a", "b"]);
        data.rows = vec![vec![0.1, -2e-300], vec![1.0 / 3.0, 4.0]];
        assert_eq!(Data::parse("x", &format!("# from nowhere\n{}", data.csv())).unwrap(), data);
        assert_eq!(data.column("b"), [-2e-300, 4.0]);
        assert!(Data::parse("x", "a,b\n1,2\n3\n").unwrap_err().contains("line 3"));
        assert!(Data::parse("x", "a,b\n1,zwei\n").unwrap_err().contains("line 2"));
        let named = Data::parse_named("x", "# source\na,two\none,1.5\ntwo,2\n", &["one", "two"]).unwrap();
        assert_eq!((named.columns, named.rows), (vec!["a".into(), "two".into()], vec![vec![0.0, 1.5], vec![1.0, 2.0]]));
    }

    #[test]
    fn a_study_without_checks_does_not_hold() {
        assert!(!Outcome::default().holds());
    }
}
