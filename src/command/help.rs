//! The end of every help: examples and exit codes.

macro_rules! help {
    ($name:ident, $codes:literal, $($example:literal $(=> $words:literal)?),+) => {
        pub const $name: &str = concat!(
            "Examples:\n",
            $("  percoat ", $example, $("   # ", $words,)? "\n",)+
            "\nExit codes: ",
            $codes
        );
    };
}

help!(
    SOLVE,
    "0 done; 2 refused, nothing written; 3 not converged, everything\ncomputed is written and marked; 4 input or output failed; 130 interrupted",
    "solve" => "the embedded default case, into out/fig2",
    "solve mine.toml -o out/mine --set grid.points=256"
);
help!(
    COMPARE,
    "0 done; 2 refused, nothing written; 3 not converged, everything\ncomputed is written and marked; 4 input or output failed; 130 interrupted",
    "compare fig2",
    "compare mine.toml --set localized.indenters=[7,37]"
);
help!(
    LIMIT,
    "0 done; 2 refused, nothing written; 3 not converged, everything\ncomputed is written and marked; 4 input or output failed; 130 interrupted",
    "limit" => "a coating of DLC on steel under sliding spheres",
    "limit mine.toml --set friction.coefficient=0.1",
    "limit ball-on-disc --up-to 20N" => "up to the load of a test"
);
help!(
    LIFE,
    "0 done; 2 refused, nothing written; 3 not converged, everything\ncomputed is written and marked; 4 input or output failed; 130 interrupted",
    "life" => "a TiN coating on steel whose interface fails by fatigue",
    "life mine.toml --set life.passes=1e7 --resume"
);
help!(
    IDENTIFY,
    "0 done; 2 refused: the curve does not determine the keys, or is\nno curve; 4 input or output failed; 130 interrupted",
    "identify data.csv mine.toml --free layers.0.young",
    "identify data.csv mine.toml --free layers.0.young,offset",
    "identify a.csv b.csv my.toml --free layers.0.young --segment unloading"
);
help!(
    SWEEP,
    "0 done; 2 refused, nothing written; 3 a combination failed or did\nnot converge, the table says why; 4 input or output failed; 130 interrupted",
    "sweep fig2 --set layers.0.thickness=0.1:1:9:log --set grid.points=128",
    "sweep a.toml --set layers.0.young=2,5 --set layers.0.thickness=1:2:5",
    "sweep a.toml --zip --set levels.0.radius=1,2 --set layers.0.young=3,4",
    "sweep mine.toml --table settings.csv --resume",
    "sweep mine.toml --set friction.coefficient=0:0.5:6 --limit",
    "sweep a.toml --vary layers.0.young=library --vary substrate.young=5%",
    "sweep mine.toml --set layers.0.thickness=0.1:1:50 --shard 3/8"
);
help!(
    MERGE,
    "0 done; 2 refused, nothing written; 3 combinations are missing,\nfailed or did not converge; 4 input or output failed",
    "merge out/mine/shard-*" => "into out/mine",
    "merge a/out b/out -o out/whole"
);
help!(
    REPORT,
    "0 done; 2 refused, nothing written; 4 input or output failed",
    "report out/fig2" => "into out/fig2/report.html",
    "report out/mine -o mine.html"
);
help!(
    KERNEL,
    "0 done; 2 refused; 4 input or output failed",
    "kernel mine.toml --wavenumber 1,10,100",
    "kernel mine.toml --wavenumber 1 --depth 0,0.5 --traction along"
);
help!(
    CHECK,
    "0 done; 2 refused; 4 input or output failed",
    "check mine.toml",
    "check - < mine.toml" => "the case from standard input"
);
help!(
    CASES,
    "0 done; 2 refused; 4 output failed",
    "cases",
    "cases fig5 > mine.toml",
    "cases fig5 --set grid.points=256"
);
help!(
    MATERIALS,
    "0 done; 2 refused; 4 output failed",
    "materials",
    "materials \"DLC a-C:H\"" => "moduli, hardness, strengths, their ranges and sources",
    "materials TiN > own.toml" => "an entry to change; then materials = \"own.toml\" in a case",
    "materials --file own.toml"
);
help!(
    EXPLAIN,
    "0 done; 2 refused; 4 output failed",
    "explain",
    "explain layers" => "the keys of a section",
    "explain load.mean_pressure.from",
    "explain --schema > percoat.schema.json"
);
#[cfg(feature = "validate")]
help!(
    VALIDATE,
    "0 every check holds; 1 one fails; 2 refused, nothing written;\n4 input or output failed; 130 interrupted",
    "validate --list",
    "validate hertz",
    "validate --expect validation/REPORT.md"
);
help!(
    COMPLETIONS,
    "0 done; 2 refused; 4 output failed",
    "completions bash > ~/.local/share/bash-completion/completions/percoat",
    "completions zsh > ~/.zfunc/_percoat",
    "completions fish > ~/.config/fish/completions/percoat.fish"
);
help!(
    MAN,
    "0 done; 2 refused; 4 output failed",
    "man > percoat.1",
    "man solve | man -l -" => "the page of one command"
);
pub const PERCOAT: &str = "\
Start:
  percoat solve                      # the embedded default case
  percoat cases dlc-on-steel > mine.toml
  percoat check mine.toml
  percoat solve mine.toml

Exit codes: 0 done; 1 a validation failed; 2 refused, nothing written; 3 not
converged; 4 input or output failed; 130 interrupted";
