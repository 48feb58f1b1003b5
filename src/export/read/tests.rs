use super::*;

#[test]
fn tables_read_with_and_without_header_and_faults_name_their_place() {
    let t = parse("x,y,z,r\n1,2,3,0.5\n\n-1e-3,0,0,2\n# volume = 4\n").unwrap();
    assert_eq!(t.spheres[1], Sphere::new(Vec3::new(-1e-3, 0.0, 0.0), 2.0));
    assert!(t.masses.is_empty());
    for text in [
        "1 2 3 0.5\n",
        "1\t2\t3\t0.5",
        "1, 2, 3,  0.5\r\n",
        "X;Y;Z;Radius\n1;2;3;0.5",
        "1,2,3,0.5,",
    ] {
        assert_eq!(parse(text).unwrap().spheres, t.spheres[..1], "{text}");
    }
    let t = parse("x,y,z,r,mass\n1,2,3,0.5,7\n").unwrap();
    assert_eq!(t.masses, [7.0]);
    for (text, place) in [
        ("a,b\n", "line 1"),
        ("x,y,z,r\n1,2,3\n", "line 2"),
        ("x,y,z,r\n1,,2,3,4\n", "line 2"),
        ("x,y,z,r\n1,2,3,4\n,1,2,3,4\n", "line 3"),
        ("x,y,z,r\n1,2,3,4,5\n", "line 2"),
        ("1 2 3 4\n1 2 3 4 5\n", "line 2"),
        ("1 2 3 4\nx\n", "line 2"),
        ("x,y,z,r\n1,2,3,nan\n", "line 2"),
        ("x,y,z,r\n1,2,3,-4\n", "line 2"),
        ("x,y,z,r,mass\n1,2,3,4,inf\n", "line 2"),
        ("", "no sphere"),
        ("x,y,z,r\n", "no sphere"),
    ] {
        assert!(parse(text).unwrap_err().to_string().contains(place), "{text}");
    }
}

#[test]
fn a_record_says_its_frame() {
    let clump = |frame: &str| parse(&format!("{{{frame}\"spheres\": [[1,2,3,0.5]]}}"));
    assert_eq!(clump("").unwrap().body_frame, None);
    assert_eq!(clump("\"frame\":\"body\",").unwrap().body_frame, Some(true));
    assert!(clump("\"frame\":\"lab\",").is_err() && clump("\"frame\":3,").is_err());
    assert!(clump("\"masses\":[1,2],").is_err() && clump("\"masses\":[\"a\"],").is_err());
    assert!(parse("{\"spheres\": [[1,2]]}").is_err() && parse("{}").is_err());
    // What is no number is not passed over.
    let e = parse("{\"spheres\": [[1,2,3,0.5],[1,2,null,3,4]]}").unwrap_err();
    assert!(e.to_string().contains("sphere 1"), "{e}");
    for (bad, word) in [
        ("\"masses\":3,", "masses"),
        ("\"masses\":[true],", "mass 0"),
        ("\"mass\":\"5\",", "mass"),
        ("\"volume\":[1],", "volume"),
    ] {
        assert!(clump(bad).unwrap_err().to_string().contains(word), "{bad}");
    }
    let t = clump("\"masses\":null,\"mass\":null,\"volume\":2,").unwrap();
    assert_eq!((t.masses.len(), t.mass, t.volume), (0, None, Some(2.0)));
}

#[test]
fn molecules_and_clusters_that_lack_something_are_refused() {
    let molecule = |masses: &str| {
        format!(
            "# a\n2 atoms\n5 mass\n\nCoords\n\n2 1 0 0\n1 0 0 0\n\nDiameters\n\n1 2\n2 3\n{masses}"
        )
    };
    let t = parse(&molecule("")).unwrap();
    assert_eq!((t.spheres[1].center.x, t.spheres[1].radius, t.mass), (1.0, 1.5, Some(5.0)));
    assert_eq!(parse(&molecule("\nMasses\n\n2 3\n1 2\n")).unwrap().masses, [2.0, 3.0]);
    for bad in ["\nMasses\n\n1 2\n", "3 1\n", "x\n0 1\n", "\nMasses\n\n1 2\n1 2\n"] {
        assert!(parse(&molecule(bad)).is_err() || bad == "x\n0 1\n", "{bad}");
    }
    let cluster =
        "Begin centers_and_radii // four\n0 0 0 1\n1 0 0 1\nEnd centers_and_radii\nVolume\n5\n";
    let t = parse(cluster).unwrap();
    assert_eq!((t.spheres.len(), t.volume), (2, Some(5.0)));
    assert!(parse("Begin centers_and_radii\n0 0 0\n").unwrap_err().to_string().contains("line 2"));
}
