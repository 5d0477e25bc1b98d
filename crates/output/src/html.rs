//! Pages that open from the disk without a network: one HTML file with its style, pictures beside it.

/// Look of the pages.
const STYLE: &str = "body{font:16px/1.45 system-ui,sans-serif;margin:2em auto;max-width:78em;padding:0 1em;color:#222}\
table{border-collapse:collapse;margin:1em 0;font-variant-numeric:tabular-nums}\
th,td{border:1px solid #ccc;padding:.3em .6em;text-align:left;vertical-align:top}th{background:#f2f2f2}\
.met{color:#00674a}.missed,.failed{color:#b3261e;font-weight:600}.wide{overflow-x:auto}\
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(17em,1fr));gap:1em}\
figure{margin:0}figure img{width:100%;border:1px solid #ddd}figcaption{font-size:.85em;color:#444}\
.diagrams{display:grid;grid-template-columns:repeat(auto-fill,minmax(30em,1fr));gap:1em}\
.curves svg,figure svg{max-width:100%;height:auto}";

/// The page with a title, given as text, around `body`, given as HTML.
pub fn page(title: &str, body: &str) -> String {
    let title = escaped(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n\
         <body>\n{body}</body>\n</html>\n"
    )
}

/// A picture that links to itself, with a caption; both are escaped already.
pub fn figure(picture: &str, caption: &str) -> String {
    figure_with_more(picture, caption, "")
}

/// The same with more HTML after the caption.
pub fn figure_with_more(picture: &str, caption: &str, more: &str) -> String {
    format!(
        "<figure><a href=\"{picture}\"><img loading=\"lazy\" src=\"{picture}\" alt=\"{caption}\"></a><figcaption>{caption}{more}</figcaption></figure>\n"
    )
}

/// The text with HTML characters escaped.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
