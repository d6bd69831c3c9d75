<?xml version="1.0" encoding="UTF-8"?>
<!-- A Digital Calibration Certificate (DCC 3) as a page for people: xsltproc view.xsl certificate.xml.
     The parameter "lang" chooses among the certificate's languages; unless given it is the one that
     the certificate makes binding. -->
<xsl:stylesheet version="1.0" xmlns:xsl="http://www.w3.org/1999/XSL/Transform"
    xmlns:dcc="https://ptb.de/dcc" xmlns:si="https://ptb.de/si" exclude-result-prefixes="dcc si">
  <xsl:output method="html" encoding="UTF-8" indent="no" doctype-system="about:legacy-compat"/>
  <xsl:variable name="core" select="/*/dcc:administrativeData/dcc:coreData"/>
  <xsl:param name="lang" select="string($core/dcc:mandatoryLangCodeISO639_1[1])"/>

  <xsl:template match="/dcc:digitalCalibrationCertificate">
    <xsl:variable name="data" select="dcc:administrativeData"/>
    <html lang="{$lang}">
      <head>
        <meta name="viewport" content="width=device-width, initial-scale=1"/>
        <title>{words:title} <xsl:value-of select="$core/dcc:uniqueIdentifier"/></title>
        <style>@STYLE@</style>
      </head>
      <body>
        <main>
          <h1>{words:title}</h1>
          <p class="settings">DCC <xsl:value-of select="@schemaVersion"/></p>
          <div class="table" tabindex="0">
            <table>
              <tbody>
                <tr><th scope="row">{words:number}</th><td><xsl:value-of select="$core/dcc:uniqueIdentifier"/></td></tr>
                <xsl:for-each select="$data/dcc:items/dcc:item">
                  <tr><th scope="row">{words:device}</th><td><xsl:apply-templates select="dcc:name"/></td></tr>
                  <xsl:for-each select="dcc:manufacturer/dcc:name">
                    <tr><th scope="row">{words:manufacturer}</th><td><xsl:apply-templates select="."/></td></tr>
                  </xsl:for-each>
                  <xsl:for-each select="dcc:model">
                    <tr><th scope="row">{words:model}</th><td><xsl:value-of select="."/></td></tr>
                  </xsl:for-each>
                  <xsl:for-each select="dcc:identifications/dcc:identification">
                    <tr><th scope="row"><xsl:apply-templates select="dcc:name"/></th><td><xsl:value-of select="dcc:value"/></td></tr>
                  </xsl:for-each>
                  <xsl:for-each select="dcc:description">
                    <tr><td/><td><xsl:apply-templates select="."/></td></tr>
                  </xsl:for-each>
                </xsl:for-each>
                <xsl:for-each select="$data/dcc:customer">
                  <tr><th scope="row">{words:customer}</th><td><xsl:call-template name="contact"/></td></tr>
                </xsl:for-each>
                <xsl:for-each select="$data/dcc:calibrationLaboratory/dcc:contact">
                  <tr><th scope="row">{words:laboratory}</th><td><xsl:call-template name="contact"/></td></tr>
                </xsl:for-each>
                <xsl:for-each select="$data/dcc:calibrationLaboratory/dcc:calibrationLaboratoryCode">
                  <tr><th scope="row">{words:code}</th><td><xsl:value-of select="."/></td></tr>
                </xsl:for-each>
                <xsl:for-each select="$data/dcc:respPersons/dcc:respPerson">
                  <tr><th scope="row">{words:responsible}</th><td><xsl:apply-templates select="dcc:person/dcc:name"/></td></tr>
                </xsl:for-each>
                <xsl:for-each select="$core/dcc:receiptDate">
                  <tr><th scope="row">{words:received}</th><td><xsl:value-of select="."/></td></tr>
                </xsl:for-each>
                <tr>
                  <th scope="row">{words:calibrated}</th>
                  <td>
                    <xsl:value-of select="$core/dcc:beginPerformanceDate"/>
                    <xsl:if test="$core/dcc:endPerformanceDate != $core/dcc:beginPerformanceDate"> – <xsl:value-of select="$core/dcc:endPerformanceDate"/></xsl:if>
                  </td>
                </tr>
                <xsl:for-each select="$core/dcc:performanceLocation">
                  <tr>
                    <th scope="row">{words:place}</th>
                    <td>
                      <xsl:choose>
                        <xsl:when test=". = 'laboratory'">{words:at_laboratory}</xsl:when>
                        <xsl:when test=". = 'customer'">{words:at_customer}</xsl:when>
                        <xsl:when test=". = 'laboratoryBranch'">{words:at_laboratory_branch}</xsl:when>
                        <xsl:when test=". = 'customerBranch'">{words:at_customer_branch}</xsl:when>
                        <xsl:when test=". = 'other'">{words:elsewhere}</xsl:when>
                        <xsl:otherwise><xsl:value-of select="."/></xsl:otherwise>
                      </xsl:choose>
                    </td>
                  </tr>
                </xsl:for-each>
                <xsl:for-each select="$core/dcc:issueDate">
                  <tr><th scope="row">{words:issued}</th><td><xsl:value-of select="."/></td></tr>
                </xsl:for-each>
                <xsl:for-each select="dcc:measurementResults/dcc:measurementResult/dcc:influenceConditions/dcc:influenceCondition">
                  <tr><th scope="row"><xsl:apply-templates select="dcc:name"/></th><td><xsl:apply-templates select="dcc:data/dcc:text"/></td></tr>
                </xsl:for-each>
                <xsl:for-each select="dcc:measurementResults/dcc:measurementResult/dcc:usedMethods/dcc:usedMethod">
                  <tr>
                    <th scope="row"><xsl:apply-templates select="dcc:name"/></th>
                    <td>
                      <xsl:apply-templates select="dcc:description"/>
                      <xsl:for-each select="dcc:norm"><xsl:if test="position() &gt; 1">, </xsl:if><xsl:value-of select="."/></xsl:for-each>
                    </td>
                  </tr>
                </xsl:for-each>
              </tbody>
            </table>
          </div>
          <xsl:variable name="results" select="dcc:measurementResults/dcc:measurementResult/dcc:results/dcc:result"/>
          <xsl:apply-templates select="$results[not(dcc:data/dcc:byteData)]" mode="data"/>
          <xsl:if test="$data/dcc:statements"><h2>{words:remarks}</h2></xsl:if>
          <xsl:for-each select="$data/dcc:statements/dcc:statement">
            <p>
              <xsl:apply-templates select="dcc:declaration"/>
              <xsl:for-each select="dcc:data/dcc:text|dcc:conformity"><xsl:text> </xsl:text><xsl:value-of select="."/></xsl:for-each>
              <xsl:if test="dcc:norm">
                <xsl:text> (</xsl:text>
                <xsl:for-each select="dcc:norm"><xsl:if test="position() &gt; 1">, </xsl:if><xsl:value-of select="."/></xsl:for-each>
                <xsl:text>)</xsl:text>
              </xsl:if>
            </p>
          </xsl:for-each>
          <xsl:apply-templates select="$results[dcc:data/dcc:byteData]" mode="data"/>
          <p class="end">{words:end}</p>
        </main>
      </body>
    </html>
  </xsl:template>

  <!-- a text in the language, or else the first that there is -->
  <xsl:template match="*[dcc:content]">
    <xsl:choose>
      <xsl:when test="dcc:content[@lang = $lang]"><xsl:value-of select="dcc:content[@lang = $lang][1]"/></xsl:when>
      <xsl:otherwise><xsl:value-of select="dcc:content[1]"/></xsl:otherwise>
    </xsl:choose>
  </xsl:template>

  <xsl:template match="dcc:result" mode="data">
    <h2><xsl:apply-templates select="dcc:name"/></h2>
    <xsl:for-each select="dcc:description"><p><xsl:apply-templates select="."/></p></xsl:for-each>
    <xsl:apply-templates select="dcc:data/*" mode="data"/>
  </xsl:template>

  <xsl:template name="contact">
    <xsl:apply-templates select="dcc:name"/>
    <xsl:for-each select="dcc:location/dcc:street">, <xsl:value-of select="."/><xsl:text> </xsl:text><xsl:value-of select="../dcc:streetNo"/></xsl:for-each>
    <xsl:for-each select="dcc:location/dcc:city">, <xsl:value-of select="../dcc:postCode"/><xsl:text> </xsl:text><xsl:value-of select="."/></xsl:for-each>
    <xsl:for-each select="dcc:location/dcc:countryCode">, <xsl:value-of select="."/></xsl:for-each>
    <xsl:for-each select="dcc:eMail">, <xsl:value-of select="."/></xsl:for-each>
  </xsl:template>

  <xsl:template match="dcc:text" mode="data"><p><xsl:apply-templates select="."/></p></xsl:template>

  <!-- files are links to what the certificate holds -->
  <xsl:template match="dcc:byteData" mode="data">
    <p>
      <xsl:apply-templates select="dcc:name"/>
      <xsl:text>: </xsl:text>
      <a download="{dcc:fileName}" href="data:{dcc:mimeType};base64,{normalize-space(dcc:dataBase64)}"><xsl:value-of select="dcc:fileName"/></a>
    </p>
  </xsl:template>

  <!-- one value, a row of a table -->
  <xsl:template match="dcc:quantity" mode="data">
    <xsl:variable name="value" select="si:real|si:constant|si:hybrid/si:real[1]"/>
    <p>
      <xsl:apply-templates select="dcc:name"/>
      <xsl:text> = </xsl:text>
      <xsl:value-of select="$value/si:value"/>
      <xsl:for-each select="$value//si:uncertainty[1]|$value//si:valueExpandedMU[1]"> ± <xsl:value-of select="."/></xsl:for-each>
      <xsl:text> </xsl:text>
      <xsl:call-template name="unit"><xsl:with-param name="unit" select="$value/si:unit"/></xsl:call-template>
      <xsl:for-each select="$value//si:coverageFactor[1]">, k = <xsl:value-of select="."/></xsl:for-each>
      <xsl:for-each select="$value/si:coverageInterval">
        <xsl:for-each select="si:standardUnc">, u = <xsl:value-of select="."/></xsl:for-each>
        <xsl:text>, [</xsl:text><xsl:value-of select="si:intervalMin"/><xsl:text>, </xsl:text><xsl:value-of select="si:intervalMax"/><xsl:text>]</xsl:text>
      </xsl:for-each>
      <xsl:for-each select="$value//si:coverageProbability[1]">, p = <xsl:value-of select="."/></xsl:for-each>
      <xsl:for-each select="dcc:relativeUncertainty/dcc:relativeUncertaintySingle">
        <xsl:text>, </xsl:text><xsl:value-of select="local-name()"/><xsl:text>: </xsl:text><xsl:value-of select="si:value"/><xsl:text> </xsl:text>
        <xsl:call-template name="unit"><xsl:with-param name="unit" select="si:unit"/></xsl:call-template>
      </xsl:for-each>
      <xsl:apply-templates select="dcc:noQuantity|dcc:charsXMLList" mode="data"/>
    </p>
  </xsl:template>

  <!-- several numbers that lie in a region together: a row for each, with the covariance matrix -->
  <xsl:template match="dcc:quantity[si:complex or si:list/si:realList]" mode="data">
    <xsl:variable name="of" select="si:complex|si:list/si:realList"/>
    <xsl:variable name="columns" select="$of//si:covarianceMatrix/si:column"/>
    <p>
      <xsl:apply-templates select="dcc:name"/>
      <xsl:for-each select="$of//si:coverageFactor[1]">, k = <xsl:value-of select="."/></xsl:for-each>
      <xsl:for-each select="$of//si:coverageProbability[1]">, p = <xsl:value-of select="."/></xsl:for-each>
    </p>
    <div class="table" tabindex="0">
      <table>
        <thead>
          <tr>
            <th scope="col"/>
            <th scope="col" class="number">{words:value}</th>
            <xsl:if test="$columns"><th scope="col" class="number" colspan="{count($columns)}">U</th></xsl:if>
          </tr>
        </thead>
        <tbody>
          <xsl:for-each select="$of/si:valueReal|$of/si:valueImag|$of/si:valueMagnitude|$of/si:valuePhase|$of/si:real/si:value">
            <xsl:variable name="row" select="position()"/>
            <tr>
              <th scope="row">
                <xsl:choose>
                  <xsl:when test="../si:label"><xsl:value-of select="../si:label"/></xsl:when>
                  <xsl:when test="self::si:valueReal">Re</xsl:when>
                  <xsl:when test="self::si:valueImag">Im</xsl:when>
                  <xsl:when test="self::si:valueMagnitude">| |</xsl:when>
                  <xsl:when test="self::si:valuePhase">arg</xsl:when>
                </xsl:choose>
              </th>
              <td class="number">
                <xsl:value-of select="."/><xsl:text> </xsl:text>
                <xsl:call-template name="unit">
                  <xsl:with-param name="unit" select="(../si:unitPhase[current()[self::si:valuePhase]]|../si:unit[not(current()[self::si:valuePhase] and ../si:unitPhase)])[1]"/>
                </xsl:call-template>
              </td>
              <xsl:for-each select="$columns">
                <td class="number">
                  <xsl:value-of select="si:covariance[$row]/si:value"/><xsl:text> </xsl:text>
                  <xsl:call-template name="unit"><xsl:with-param name="unit" select="si:covariance[$row]/si:unit"/></xsl:call-template>
                </td>
              </xsl:for-each>
            </tr>
          </xsl:for-each>
        </tbody>
      </table>
    </div>
  </xsl:template>

  <!-- quantities over rows: a column for each, with its uncertainty -->
  <xsl:template match="dcc:list" mode="data">
    <xsl:if test="dcc:name"><p><xsl:apply-templates select="dcc:name"/></p></xsl:if>
    <xsl:call-template name="lists">
      <xsl:with-param name="lists" select="dcc:quantity[si:realListXMLList or si:hybrid/si:realListXMLList]"/>
    </xsl:call-template>
    <xsl:apply-templates select="dcc:quantity[not(si:realListXMLList or si:hybrid/si:realListXMLList)]|dcc:list" mode="data"/>
  </xsl:template>

  <!-- numbers of one quantity: a table of its own -->
  <xsl:template match="dcc:quantity[si:realListXMLList or si:hybrid/si:realListXMLList]" mode="data">
    <xsl:call-template name="lists"><xsl:with-param name="lists" select="."/></xsl:call-template>
  </xsl:template>

  <xsl:template name="lists">
    <xsl:param name="lists"/>
    <xsl:if test="$lists">
      <div class="table long" tabindex="0">
        <table>
          <thead>
            <tr>
              <xsl:for-each select="$lists">
                <xsl:variable name="list" select="si:realListXMLList|si:hybrid/si:realListXMLList[1]"/>
                <xsl:if test="$list/si:coverageIntervalXMLList and not(@refType = 'gumption_coverageInterval')">
                  <th scope="col" class="number">
                    <xsl:apply-templates select="dcc:name"/><br/>
                    <xsl:call-template name="unit"><xsl:with-param name="unit" select="$list/si:unitXMLList"/></xsl:call-template>
                  </th>
                </xsl:if>
                <xsl:choose>
                  <xsl:when test="$list/si:coverageIntervalXMLList">
                    <th scope="col" class="number"><xsl:apply-templates select="dcc:name"/><br/>{words:low}</th>
                    <th scope="col" class="number"><br/>{words:high}</th>
                  </xsl:when>
                  <xsl:otherwise>
                    <th scope="col" class="number">
                      <xsl:apply-templates select="dcc:name"/><br/>
                      <xsl:call-template name="unit"><xsl:with-param name="unit" select="$list/si:unitXMLList"/></xsl:call-template>
                    </th>
                  </xsl:otherwise>
                </xsl:choose>
                <xsl:if test="$list/si:expandedUncXMLList">
                  <th scope="col" class="number">{words:expanded}</th>
                  <th scope="col" class="number">k</th>
                  <th scope="col" class="number">p</th>
                </xsl:if>
              </xsl:for-each>
            </tr>
          </thead>
          <tbody>
            <xsl:call-template name="rows">
              <xsl:with-param name="lists" select="$lists"/>
              <xsl:with-param name="left" select="normalize-space(($lists[1]/si:realListXMLList|$lists[1]/si:hybrid/si:realListXMLList[1])/si:valueXMLList)"/>
            </xsl:call-template>
          </tbody>
        </table>
      </div>
    </xsl:if>
  </xsl:template>

  <!-- a row for each value that is left of the first list -->
  <xsl:template name="rows">
    <xsl:param name="lists"/>
    <xsl:param name="left"/>
    <xsl:param name="row" select="1"/>
    <xsl:if test="$left != ''">
      <tr>
        <xsl:for-each select="$lists/si:realListXMLList|$lists/si:hybrid/si:realListXMLList[1]">
          <xsl:if test="si:coverageIntervalXMLList and not(ancestor::dcc:quantity[1]/@refType = 'gumption_coverageInterval')">
            <xsl:call-template name="cell"><xsl:with-param name="of" select="si:valueXMLList"/><xsl:with-param name="row" select="$row"/></xsl:call-template>
          </xsl:if>
          <xsl:choose>
            <xsl:when test="si:coverageIntervalXMLList">
              <xsl:call-template name="cell"><xsl:with-param name="of" select="si:coverageIntervalXMLList/si:intervalMinXMLList"/><xsl:with-param name="row" select="$row"/></xsl:call-template>
              <xsl:call-template name="cell"><xsl:with-param name="of" select="si:coverageIntervalXMLList/si:intervalMaxXMLList"/><xsl:with-param name="row" select="$row"/></xsl:call-template>
            </xsl:when>
            <xsl:otherwise>
              <xsl:call-template name="cell"><xsl:with-param name="of" select="si:valueXMLList"/><xsl:with-param name="row" select="$row"/></xsl:call-template>
            </xsl:otherwise>
          </xsl:choose>
          <xsl:for-each select="si:expandedUncXMLList">
            <xsl:call-template name="cell"><xsl:with-param name="of" select="si:uncertaintyXMLList"/><xsl:with-param name="row" select="$row"/></xsl:call-template>
            <xsl:call-template name="cell"><xsl:with-param name="of" select="si:coverageFactorXMLList"/><xsl:with-param name="row" select="$row"/></xsl:call-template>
            <xsl:call-template name="cell"><xsl:with-param name="of" select="si:coverageProbabilityXMLList"/><xsl:with-param name="row" select="$row"/></xsl:call-template>
          </xsl:for-each>
        </xsl:for-each>
      </tr>
      <xsl:call-template name="rows">
        <xsl:with-param name="lists" select="$lists"/>
        <xsl:with-param name="left" select="substring-after($left, ' ')"/>
        <xsl:with-param name="row" select="$row + 1"/>
      </xsl:call-template>
    </xsl:if>
  </xsl:template>

  <!-- a list of one value holds it for every row -->
  <xsl:template name="cell">
    <xsl:param name="of"/>
    <xsl:param name="row"/>
    <xsl:variable name="text" select="normalize-space($of)"/>
    <td class="number">
      <xsl:choose>
        <xsl:when test="contains($text, ' ')">
          <xsl:call-template name="word"><xsl:with-param name="text" select="$text"/><xsl:with-param name="place" select="$row"/></xsl:call-template>
        </xsl:when>
        <xsl:otherwise><xsl:value-of select="$text"/></xsl:otherwise>
      </xsl:choose>
    </td>
  </xsl:template>

  <xsl:template name="word">
    <xsl:param name="text"/>
    <xsl:param name="place"/>
    <xsl:choose>
      <xsl:when test="$place &gt; 1">
        <xsl:call-template name="word"><xsl:with-param name="text" select="substring-after($text, ' ')"/><xsl:with-param name="place" select="$place - 1"/></xsl:call-template>
      </xsl:when>
      <xsl:otherwise><xsl:value-of select="substring-before(concat($text, ' '), ' ')"/></xsl:otherwise>
    </xsl:choose>
  </xsl:template>

  <!-- D-SI units as print has them; those that the SI does not have stand behind a bar -->
  <xsl:template name="unit">
    <xsl:param name="unit"/>
    <xsl:choose>
      <xsl:when test="starts-with($unit, '|')"><xsl:value-of select="substring($unit, 2)"/></xsl:when>
      <xsl:when test="$unit = '\one'"/>
      <xsl:when test="starts-with($unit, '\')">
        <xsl:call-template name="factors"><xsl:with-param name="names" select="substring($unit, 2)"/></xsl:call-template>
      </xsl:when>
      <xsl:otherwise><xsl:value-of select="$unit"/></xsl:otherwise>
    </xsl:choose>
  </xsl:template>

  <!-- the names of a unit, the first without its backslash, behind what parts it from those before -->
  <xsl:template name="factors">
    <xsl:param name="names"/>
    <xsl:param name="before" select="''"/>
    <xsl:variable name="name" select="translate(substring-before(concat($names, '\'), '\'), 'ABCDEFGHIJKLMNOPQRSTUVWXYZ', 'abcdefghijklmnopqrstuvwxyz')"/>
    <xsl:variable name="rest" select="substring-after($names, '\')"/>
    <xsl:variable name="prefix">
      <xsl:choose>{units:prefixes}</xsl:choose>
    </xsl:variable>
    <xsl:choose>
      <xsl:when test="starts-with($name, 'tothe{')">
        <sup><xsl:value-of select="translate(substring-before(substring-after($name, '{'), '}'), '-', '&#8722;')"/></sup>
      </xsl:when>
      <xsl:when test="$name = 'per'">/</xsl:when>
      <xsl:when test="string($prefix)"><xsl:value-of select="concat($before, $prefix)"/></xsl:when>
      <xsl:otherwise>
        <xsl:value-of select="$before"/>
        <xsl:choose>{units:symbols}<xsl:otherwise><xsl:value-of select="$name"/></xsl:otherwise></xsl:choose>
      </xsl:otherwise>
    </xsl:choose>
    <xsl:if test="string($rest)">
      <xsl:call-template name="factors">
        <xsl:with-param name="names" select="$rest"/>
        <xsl:with-param name="before">
          <xsl:if test="$name != 'per' and not(string($prefix))">&#160;</xsl:if>
        </xsl:with-param>
      </xsl:call-template>
    </xsl:if>
  </xsl:template>
</xsl:stylesheet>
