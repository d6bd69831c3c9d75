fn main() {
    for path in std::env::args().skip(1) {
        match gumption::file::read_case(std::path::Path::new(&path)) {
            Ok(file) => {
                println!("{path}");
                gumption::gap::probe(&file.case)
            }
            Err(e) => println!("{e}"),
        }
    }
}
